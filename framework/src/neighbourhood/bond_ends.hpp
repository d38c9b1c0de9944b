// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The values that a bond reads from its other end: fields over points and images.
#pragma once

#include "neighbourhood/neighbourhood.hpp"
#include "state/aligned.hpp"

#include <cstddef>
#include <span>
#include <vector>

namespace periporo {

/// One end of bonds, on one cache line.
struct alignas(64) BondEnd {
    double position[3]; ///< [m]
    double volume;      ///< [m3]
    double velocity[3]; ///< [m/s]
    double mass;        ///< [kg]

    Vector3 x() const { return {position[0], position[1], position[2]}; }
    Vector3 v() const { return {velocity[0], velocity[1], velocity[2]}; }
};

/// Suction [Pa] and saturation [-] at an end of bonds.
struct EndWater {
    double suction = 0.0;
    double saturation = 0.0;
};

/// All ends of bonds: points, then images. Images have the positions and velocities under their isometries.
class BondEnds {
public:
    /// Gathers positions, volumes, masses and water of the points, with velocities that may be others than theirs.
    void gather(const Points& points, const std::vector<Vector3>& velocity, const Neighbourhood& neighbourhood);

    std::size_t size() const { return ends_.size(); }
    const BondEnd& operator[](std::size_t end) const { return ends_[end]; }
    /// Has some point suction or saturation? Otherwise water is not gathered.
    bool wet() const { return wet_; }
    const EndWater& water(std::size_t end) const { return water_[end]; }
    /// Of a bond: the mean of its ends.
    EndWater water_between(std::size_t one, std::size_t other) const
    {
        const EndWater &a = water_[one], &b = water_[other];
        return {0.5 * (a.suction + b.suction), 0.5 * (a.saturation + b.saturation)};
    }
    std::size_t memory() const; ///< [bytes]

private:
    void gather_water(const Points& points, const Neighbourhood& neighbourhood);

    AlignedVector<BondEnd> ends_;
    std::vector<EndWater> water_;
    bool wet_ = false;
};

} // namespace periporo
