/* Copyright 2026 The periporo authors
   SPDX-License-Identifier: BSD-3-Clause

   What the routines of misbehaving.c do, by the first property; for the routines and their tests. */
#pragma once

enum Way {
    smaller_step = 1,
    leave,
    stop_with_error,
    report_error,
    warn,
    not_finite,
    state_not_finite,
    past_state,
    stop_statement,
    end_program
};
