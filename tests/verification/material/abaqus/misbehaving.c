/* Copyright 2026 The periporo authors
   SPDX-License-Identifier: BSD-3-Clause

   Routines that go wrong where the strain 11 exceeds 0.01, in the way that the first property says. */
#include "misbehaving_ways.h"
#include "routine.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

void xit_(void);
void xplb_exit_(void);
void stdb_abqerr_(const int* lop, const char* text, const int* integers, const double* reals, const char* texts,
                  size_t text_length, size_t texts_length);

/* of gfortran's run-time library: what it makes of STOP 'bad props' */
void _gfortran_stop_string(const char* text, size_t length, _Bool quiet);

static void message(int lop, int number)
{
    static const char text[] = "level %I, strain %R in %S: 5 % too much   ";
    const double strain = 0.02;
    stdb_abqerr_(&lop, text, &number, &strain, "clay    ", strlen(text), 8);
}

UMAT_ROUTINE(umat_)
{
    statev[0] += 1.0;
    if (dstran[0] <= 0.01)
        return;
    switch ((enum Way)props[0]) {
    case smaller_step:
        *pnewdt = 0.5;
        return;
    case leave:
        xit_();
        abort(); /* XIT does not return */
    case stop_with_error:
        message(-3, 7);
        abort();
    case report_error:
        message(-2, 8);
        return;
    case warn:
        message(-1, 9);
        return;
    case not_finite:
        stress[4] = NAN;
        return;
    case state_not_finite:
        statev[0] = INFINITY;
        return;
    case past_state:
        statev[*nstatv] = 1.0;
        return;
    case stop_statement:
        _gfortran_stop_string("bad props", 9, 0);
        abort(); /* nor does STOP */
    case end_program:
        exit(0);
    }
}

VUMAT_ROUTINE(vumat_)
{
    for (int k = 0; k < *nblock; ++k) {
        if (strain_inc[k] <= 0.01)
            continue;
        if ((enum Way)props[0] == leave) {
            xplb_exit_();
            abort();
        }
        if ((enum Way)props[0] == not_finite)
            stress_new[5 * *nblock + k] = NAN;
        if ((enum Way)props[0] == past_state)
            state_new[*nstatev * *nblock] = 1.0;
    }
}
