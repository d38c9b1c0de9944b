/* Copyright 2026 The periporo authors
   SPDX-License-Identifier: BSD-3-Clause

   Writes what the utility routines make of the stress into the state variables: SINV 1-2, SPRINC 3-5, SPRIND 6-17,
   ROTSIG of the stress 18-23, of the same numbers as strains 24-29, SPRINC of them as strains 30-32. The properties are
   the rotation, by columns. The VUMAT writes VSPRINC 1-3. */
#include "routine.h"

#include <string.h>

void sinv_(const double* stress, double* mean, double* mises, const int* ndi, const int* nshr);
void sprinc_(const double* tensor, double* values, const int* lstr, const int* ndi, const int* nshr);
void sprind_(const double* tensor, double* values, double* directions, const int* lstr, const int* ndi,
             const int* nshr);
void rotsig_(const double* tensor, const double* rotation, double* rotated, const int* lstr, const int* ndi,
             const int* nshr);
void vsprinc_(const int* nblock, const double* tensors, double* values, const int* ndir, const int* nshr);

UMAT_ROUTINE(umat_)
{
    const int of_stress = 1, of_strain = 2;
    sinv_(stress, statev, statev + 1, ndi, nshr);
    sprinc_(stress, statev + 2, &of_stress, ndi, nshr);
    sprind_(stress, statev + 5, statev + 8, &of_stress, ndi, nshr);
    rotsig_(stress, props, statev + 17, &of_stress, ndi, nshr);
    rotsig_(stress, props, statev + 23, &of_strain, ndi, nshr);
    sprinc_(stress, statev + 29, &of_strain, ndi, nshr);
}

VUMAT_ROUTINE(vumat_)
{
    vsprinc_(nblock, stress_old, state_new, ndir, nshr);
}
