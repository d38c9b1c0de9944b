// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The volume that a point occupies among its neighbours, and how J follows it where neighbours change.
#pragma once

#include "model/model.hpp"

#include <cstddef>

namespace periporo {

/// Measures from positions alone how much volume a point occupies, as a mean over its horizon.
///
/// With W(r) = 315/(64 pi delta^3) (1 - r^2/delta^2)^3, whose integral over the horizon is 1, and V0 the initial
/// volumes,
///
///     V/V0 = support/sum_j V0_j W(|x_j - x_i|), j = i included,
///     support = integral of W over the part of the horizon that the body fills.
///
/// Inside the body support = 1. Near a face it is a mean over 32 directions: along each of them the body ends where a
/// ray from the point leaves the last ball of 0.67 spacings around a neighbour. A single point has V/V0 = 1.2.
/// On lattices of any orientation, compressed, dilated or sheared, the measure is right within 2 per cent inside (0.5
/// on the average). Near faces and edges it is up to 5 per cent too large on the average, and up to 20 at a corner.
class OccupiedVolume {
public:
    OccupiedVolume(double spacing, double horizon);

    struct Measure {
        double ratio;   ///< V/V0 [-]
        double support; ///< filled part of the horizon, weighted with W [-]
    };
    /// Of a point in its family, from the records and the initial volumes.
    Measure of_point(const Model& model, std::size_t point) const;

private:
    double horizon_;
    double ball_squared_;
    double weight_at_centre_; ///< W(0) [1/m3]
    double lattice_ = 1.0;    ///< scales the measure so that it is 1 inside a cubic lattice
    double whole_ = 1.0;      ///< support of a point inside a cubic lattice before it is scaled to 1
};

/// Moves J of each point whose family is not the one before towards the occupied volume, and the volume with J.
/// A fraction e of the neighbours exchanged, those that came and went over those before and after, takes away the part
/// min(1, 8 e) of what ln J lies outside of the uncertainty of the measure: 0.01 + 0.08 (1 - support) to either side.
/// Without exchange, in bodies that are at rest, move rigidly or deform little, J keeps its bits.
///
/// No point moves and no stress changes, so that neither pressure nor work arises. Records must be up to date, and are
/// afterwards.
/// @param before the families until now
void follow_occupied_volume(Model& model, const Families& before);

} // namespace periporo
