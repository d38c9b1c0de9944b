/* Copyright 2026 The periporo authors
   SPDX-License-Identifier: BSD-3-Clause

   Calls a utility routine of Abaqus that exists nowhere else. */
#include "routine.h"

void getvrm_(void);

UMAT_ROUTINE(umat_)
{
    getvrm_();
}
