// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Calls a VUMAT, many bonds in one call.
#pragma once

#include "routine_call.hpp"

namespace periporo::abaqus {

/// subroutine vumat as Fortran compilers pass its arguments: all by reference, the length of cmname behind them. Arrays
/// run over the block first: component c of member k is at [c * nblock + k].
/// Source: Abaqus User Subroutines Reference Guide, VUMAT. `jblock` serves for nblock as for jblock(*), `info` for
/// lanneal as for jInfoArray(*), `dt` for dt as for dtArray(*): the releases differ.
using Vumat = void(int* jblock, int* ndir, int* nshr, int* nstatev, int* nfieldv, int* nprops, int* info,
                   double* step_time, double* total_time, double* dt, char* cmname, double* coord_mp,
                   double* char_length, double* props, double* density, double* strain_inc, double* rel_spin_inc,
                   double* temp_old, double* stretch_old, double* defgrad_old, double* field_old, double* stress_old,
                   double* state_old, double* ener_intern_old, double* ener_inelas_old, double* temp_new,
                   double* stretch_new, double* defgrad_new, double* field_new, double* stress_new, double* state_new,
                   double* ener_intern_new, double* ener_inelas_new, std::size_t cmname_length);

class VumatCall final : public RoutineCall {
public:
    VumatCall(Vumat* routine, const RoutineSettings& settings);

    void advance(const MaterialBatch& batch) override;

private:
    /// Many routines have local arrays of maxblk = 136 members.
    static constexpr std::size_t largest_block = 128;

    RoutineFailure advance_block(const MaterialBatch& batch);
    /// Fills what the routine reads, but for stress, state and strain increment.
    void fill_surroundings(const MaterialBatch& batch);
    void call(double time_step);
    RoutineFailure store(const MaterialBatch& batch);

    Vumat* routine_;
    std::vector<std::size_t> block_; ///< the bonds of one call
    std::vector<double> stress_old_, stress_new_, strain_increment_, state_old_;
    GuardedArray state_new_;
    std::vector<double> place_, length_, density_, spin_, temperature_old_, temperature_new_, fields_old_, fields_new_;
    std::vector<double> stretch_old_, stretch_new_, gradient_old_, gradient_new_, time_steps_;
    std::vector<double> internal_old_, internal_new_, inelastic_old_, inelastic_new_;
    std::vector<int> block_numbers_, information_;
};

} // namespace periporo::abaqus
