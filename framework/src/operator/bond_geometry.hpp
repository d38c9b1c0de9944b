// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Where the neighbours of a point are and how they move, one bond a lane.
#pragma once

#include "neighbourhood/bond_ends.hpp"
#include "operator/bond_vector.hpp"
#include "operator/influence.hpp"
#include "operator/transpose.hpp"

namespace periporo {

/// The geometry of a pack of bonds.
struct BondGeometry {
    BondVector zeta;
    BondVector along;  ///< zeta/|zeta|^2; zero in lanes without a bond
    BondVector motion; ///< v_j - v_i
    Pack squared;      ///< |zeta|^2
    Pack omega;        ///< zero in lanes without a bond
    Pack volume;       ///< of the neighbour

    BondGeometry(const BondEnds& ends, std::size_t point, const std::uint32_t* neighbours, const PackMask& bonds,
                 const Influence& influence)
    {
        const BondEnd& self = ends[point];
        const std::array<Pack, 8> other =
            load_transposed<8>([&](std::size_t lane) { return ends[neighbours[lane]].position; });
        for (std::size_t c = 0; c < 3; ++c) {
            zeta[c] = other[c] - self.position[c];
            motion[c] = other[4 + c] - self.velocity[c];
        }
        squared = dot(zeta, zeta);
        const PackMask real = bonds && squared > Pack(0.0);
        along = times(select(real, Pack(1.0) / squared, Pack(0.0)), zeta);
        omega = select(real, influence(squared), Pack(0.0));
        volume = other[3];
    }
};

} // namespace periporo
