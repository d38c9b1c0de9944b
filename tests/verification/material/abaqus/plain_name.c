/* Copyright 2026 The periporo authors
   SPDX-License-Identifier: BSD-3-Clause

   A routine whose name has no underscore, as a compiler other than Fortran's or -fno-underscoring makes it. */
#include "routine.h"

UMAT_ROUTINE(umat)
{
    stress[0] += props[0] * dstran[0];
}
