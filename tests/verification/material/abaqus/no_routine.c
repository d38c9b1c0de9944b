/* Copyright 2026 The periporo authors
   SPDX-License-Identifier: BSD-3-Clause

   A library without a routine. */
double helper(double strain)
{
    return 2.0 * strain;
}
