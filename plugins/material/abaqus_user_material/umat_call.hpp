// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Calls a UMAT, bond by bond.
#pragma once

#include "routine_call.hpp"

namespace periporo::abaqus {

/// SUBROUTINE UMAT as Fortran compilers pass its arguments: all by reference, the length of CMNAME behind them.
/// Source: Abaqus User Subroutines Reference Guide, UMAT. The argument KSTEP of older releases is JSTEP(1).
using Umat = void(double* stress, double* statev, double* ddsdde, double* sse, double* spd, double* scd, double* rpl,
                  double* ddsddt, double* drplde, double* drpldt, double* stran, double* dstran, double* time,
                  double* dtime, double* temp, double* dtemp, double* predef, double* dpred, char* cmname, int* ndi,
                  int* nshr, int* ntens, int* nstatv, double* props, int* nprops, double* coords, double* drot,
                  double* pnewdt, double* celent, double* dfgrd0, double* dfgrd1, int* noel, int* npt, int* layer,
                  int* kspt, int* jstep, int* kinc, std::size_t cmname_length);

class UmatCall final : public RoutineCall {
public:
    UmatCall(Umat* routine, const RoutineSettings& settings)
        : RoutineCall(settings), routine_(routine), state_(settings.state_count)
    {
    }

    void advance(const MaterialBatch& batch) override;

private:
    RoutineFailure advance_bond(const Bond& member, double time_step);

    Umat* routine_;
    GuardedArray state_;
};

} // namespace periporo::abaqus
