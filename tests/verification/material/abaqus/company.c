/* Copyright 2026 The periporo authors
   SPDX-License-Identifier: BSD-3-Clause

   Waits for another thread to come in, at most as many seconds as the first property says, and writes into its state
   variable how many threads were inside. */
#include "routine.h"

#include <sched.h>
#include <stdatomic.h>
#include <time.h>

static double now(void)
{
    struct timespec time;
    clock_gettime(CLOCK_MONOTONIC, &time);
    return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

UMAT_ROUTINE(umat_)
{
    static atomic_int inside, meetings;
    const int met_before = atomic_load(&meetings);
    statev[0] = 1.0;
    if (atomic_fetch_add(&inside, 1) > 0) {
        atomic_fetch_add(&meetings, 1);
        statev[0] = 2.0;
    }
    for (const double end = now() + props[0]; statev[0] < 2.0 && now() < end; sched_yield())
        if (atomic_load(&meetings) != met_before)
            statev[0] = 2.0;
    atomic_fetch_sub(&inside, 1);
}
