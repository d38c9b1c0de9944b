// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The result of an evaluation of the operator: forces, work, dilation, activity, times.
#pragma once

#include "neighbourhood/families.hpp"
#include "periporo/tensor.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace periporo {

/// Which bonds carry stress: for each pack of a family one bit a bond.
struct ActiveBonds : std::vector<std::uint8_t> {
    /// Does bond b of a family carry stress?
    bool holds(const FamilyView& family, std::size_t b) const
    {
        return ((*this)[family.first_pack + b / pack_width] >> b % pack_width & 1u) != 0;
    }
};

/// Seconds that a sample of the points took of an evaluation, by its parts; only their ratios mean something.
struct OperatorTimes {
    double kinematics = 0.0;
    double material = 0.0;
    double force = 0.0;

    OperatorTimes& operator+=(const OperatorTimes& other)
    {
        kinematics += other.kinematics, material += other.material, force += other.force;
        return *this;
    }
};

struct OperatorResult {
    // of each point
    std::vector<Vector3> internal_force;       ///< [N]
    std::vector<double> volume_rate;           ///< tr L dt [-]
    std::vector<double> stress_work;           ///< of the step: V sum_b w_b sigma_b : D_b dt [J]
    std::vector<std::uint32_t> inactive_bonds; ///< number of bonds without stress
    std::vector<std::uint8_t> detached;        ///< 1: the point has no active bond
    ActiveBonds active;
    OperatorTimes times; ///< of evaluations since they were set to zero

    /// Makes room for all points, with no forces; no point is detached.
    void resize(std::size_t points);
    std::size_t memory() const; ///< [bytes]

    /// What the next step reads.
    template <class Self, class Visit>
    static void members(Self& self, Visit& visit)
    {
        visit("inactive_bonds", self.inactive_bonds);
        visit("detached", self.detached);
        visit("active", self.active);
    }
};

} // namespace periporo
