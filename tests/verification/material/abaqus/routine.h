/* Copyright 2026 The periporo authors
   SPDX-License-Identifier: BSD-3-Clause

   The argument lists of UMAT and VUMAT for routines written in C: what Fortran calls takes arguments by reference. */
#ifndef PERIPORO_TESTS_ABAQUS_ROUTINE_H
#define PERIPORO_TESTS_ABAQUS_ROUTINE_H

#include <stddef.h>

#define UMAT_ROUTINE(symbol)                                                                                           \
    void symbol(double* stress, double* statev, double* ddsdde, double* sse, double* spd, double* scd, double* rpl,    \
                double* ddsddt, double* drplde, double* drpldt, double* stran, double* dstran, const double* time,     \
                const double* dtime, const double* temp, const double* dtemp, const double* predef,                    \
                const double* dpred, const char* cmname, const int* ndi, const int* nshr, const int* ntens,            \
                const int* nstatv, const double* props, const int* nprops, const double* coords, const double* drot,   \
                double* pnewdt, const double* celent, const double* dfgrd0, const double* dfgrd1, const int* noel,     \
                const int* npt, const int* layer, const int* kspt, const int* jstep, const int* kinc,                  \
                size_t cmname_length)

#define VUMAT_ROUTINE(symbol)                                                                                          \
    void symbol(const int* nblock, const int* ndir, const int* nshr, const int* nstatev, const int* nfieldv,           \
                const int* nprops, const int* lanneal, const double* step_time, const double* total_time,              \
                const double* dt, const char* cmname, const double* coord_mp, const double* char_length,               \
                const double* props, const double* density, const double* strain_inc, const double* rel_spin_inc,      \
                const double* temp_old, const double* stretch_old, const double* defgrad_old, const double* field_old, \
                const double* stress_old, const double* state_old, const double* ener_intern_old,                      \
                const double* ener_inelas_old, const double* temp_new, const double* stretch_new,                      \
                const double* defgrad_new, const double* field_new, double* stress_new, double* state_new,             \
                double* ener_intern_new, double* ener_inelas_new, size_t cmname_length)

#endif
