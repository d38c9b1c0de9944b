/* Copyright 2026 The periporo authors
   SPDX-License-Identifier: BSD-3-Clause

   Writes what it is given into its state variables; a not-a-number is written as -999. */
#include "routine.h"

#include <math.h>

static double written(double value)
{
    return isnan(value) ? -999.0 : value;
}

UMAT_ROUTINE(umat_)
{
    const double values[] = {
        *ndi,    *nshr,     *ntens,    *nstatv,   *nprops,        props[0],       props[1],      *dtime,   *temp,
        *dtemp,  predef[0], predef[1], dpred[0],  dpred[1],       *celent,        *noel,         *npt,     jstep[0],
        *kinc,   *pnewdt,   cmname[0], cmname[2], cmname[3],      cmname[79],     cmname_length, stran[0], stran[5],
        time[0], time[1],   coords[2], dfgrd0[0], dfgrd0[1],      dfgrd1[8],      dfgrd1[3],     drot[0],  drot[1],
        drot[4], drot[8],   ddsdde[7], *sse,      props[*nprops], statev[*nstatv]};
    for (int n = 0; n < *nstatv; ++n)
        statev[n] = written(values[n]);
}

VUMAT_ROUTINE(vumat_)
{
    const int block = *nblock;
    for (int k = 0; k < block; ++k) {
        const double values[] = {block,
                                 *ndir,
                                 *nshr,
                                 *nstatev,
                                 *nfieldv,
                                 *nprops,
                                 *lanneal,
                                 *step_time,
                                 *total_time,
                                 *dt,
                                 cmname[0],
                                 cmname[79],
                                 cmname_length,
                                 char_length[k],
                                 temp_old[k],
                                 temp_new[k],
                                 field_old[k],
                                 field_old[block + k],
                                 field_new[block + k],
                                 coord_mp[2 * block + k],
                                 rel_spin_inc[k],
                                 stretch_new[2 * block + k],
                                 stretch_old[3 * block + k],
                                 defgrad_new[2 * block + k],
                                 defgrad_old[8 * block + k],
                                 density[k],
                                 nblock[4 + k],
                                 props[*nprops - 1]};
        for (int s = 0; s < *nstatev; ++s)
            state_new[s * block + k] = written(values[s]);
    }
}
