/* Copyright 2026 The periporo authors
   SPDX-License-Identifier: BSD-3-Clause

   Orthotropic elasticity as a UMAT and as a VUMAT: nine different constants, so that components in a wrong order or a
   wrong factor of shear show. Properties: C11 C22 C33 C12 C13 C23 G12 G13 G23. */
#include "routine.h"

static void add_direct(const double* props, const double strain[3], double stress[3])
{
    stress[0] += props[0] * strain[0] + props[3] * strain[1] + props[4] * strain[2];
    stress[1] += props[3] * strain[0] + props[1] * strain[1] + props[5] * strain[2];
    stress[2] += props[4] * strain[0] + props[5] * strain[1] + props[2] * strain[2];
}

/* Components 11 22 33 12 13 23, engineering shear. */
UMAT_ROUTINE(umat_)
{
    add_direct(props, dstran, stress);
    for (int n = 0; n < 3; ++n)
        stress[3 + n] += props[6 + n] * dstran[3 + n];
    dstran[0] = stran[0] = 1.0; /* some routines write on their arguments */
    ddsdde[35] = 1.0;
}

/* Components 11 22 33 12 23 13, tensor shear. */
VUMAT_ROUTINE(vumat_)
{
    static const int modulus_of[3] = {6, 8, 7};
    const int block = *nblock;
    for (int k = 0; k < block; ++k) {
        double strain[3], stress[3];
        for (int c = 0; c < 3; ++c) {
            strain[c] = strain_inc[c * block + k];
            stress[c] = stress_old[c * block + k];
        }
        add_direct(props, strain, stress);
        for (int c = 0; c < 3; ++c) {
            stress_new[c * block + k] = stress[c];
            stress_new[(3 + c) * block + k] =
                stress_old[(3 + c) * block + k] + 2.0 * props[modulus_of[c]] * strain_inc[(3 + c) * block + k];
        }
    }
}
