/* Copyright 2026 The periporo authors
   SPDX-License-Identifier: BSD-3-Clause

   Von Mises plasticity with linear isotropic hardening, backward Euler (radial return), as a UMAT and as a VUMAT.
   Properties: K, G, yield stress, hardening modulus. State variables: equivalent plastic strain, number of plastic
   steps. */
#include "routine.h"

#include <math.h>

/* One step of one point; shear components in any one order, strains as tensor components. */
static void advance(const double* props, const double strain[6], double stress[6], double state[2])
{
    const double bulk = props[0], shear = props[1];
    const double volume = strain[0] + strain[1] + strain[2];
    double mean = 0.0, deviator[6], squared = 0.0;
    for (int c = 0; c < 6; ++c)
        stress[c] += 2.0 * shear * strain[c] + (c < 3 ? (bulk - 2.0 / 3.0 * shear) * volume : 0.0);
    mean = (stress[0] + stress[1] + stress[2]) / 3.0;
    for (int c = 0; c < 6; ++c) {
        deviator[c] = stress[c] - (c < 3 ? mean : 0.0);
        squared += (c < 3 ? 1.0 : 2.0) * deviator[c] * deviator[c];
    }
    const double mises = sqrt(1.5 * squared);
    const double excess = mises - (props[2] + props[3] * state[0]);
    if (excess <= 0.0)
        return;
    const double plastic = excess / (3.0 * shear + props[3]);
    for (int c = 0; c < 6; ++c)
        stress[c] -= 3.0 * shear * plastic / mises * deviator[c];
    state[0] += plastic;
    state[1] += 1.0;
}

UMAT_ROUTINE(umat_)
{
    double strain[6];
    for (int c = 0; c < 6; ++c)
        strain[c] = (c < 3 ? 1.0 : 0.5) * dstran[c];
    advance(props, strain, stress, statev);
}

VUMAT_ROUTINE(vumat_)
{
    const int block = *nblock;
    for (int k = 0; k < block; ++k) {
        double strain[6], stress[6], state[2];
        for (int c = 0; c < 6; ++c) {
            strain[c] = strain_inc[c * block + k];
            stress[c] = stress_old[c * block + k];
        }
        for (int s = 0; s < 2; ++s)
            state[s] = state_old[s * block + k];
        advance(props, strain, stress, state);
        for (int c = 0; c < 6; ++c)
            stress_new[c * block + k] = stress[c];
        for (int s = 0; s < 2; ++s)
            state_new[s * block + k] = state[s];
    }
}
