// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// An evaluation of the operator: what it reads, what it does with the stress, and how it fails.
#pragma once

#include "neighbourhood/bond_ends.hpp"
#include "neighbourhood/neighbourhood.hpp"
#include "periporo/material.hpp"
#include "state/state.hpp"

#include <cstddef>
#include <stdexcept>
#include <string>

namespace periporo {

/// What an evaluation does with the stress of the bonds.
enum class StressUpdate {
    advance, ///< by the material over one step
    keep,    ///< forces of the stress as it is
    tangent  ///< forces of the stress C : D alone, velocities taken as displacements; states are not touched
};

struct Evaluation {
    StressUpdate stress = StressUpdate::advance;
    MaterialResponse response = MaterialResponse::full;
    double time_step = 0.0; ///< [s]

    /// How far behind the positions lie those that velocity gradients refer to [s].
    double gradient_lag() const { return stress == StressUpdate::advance ? 0.5 * time_step : 0.0; }
};

/// All that an evaluation reads. Velocities are those of the ends of bonds.
struct OperatorInput {
    const State& state;
    const Neighbourhood& neighbourhood;
    const BondEnds& ends;

    std::size_t size() const { return state.size(); }
    FamilyView family(std::size_t point) const { return neighbourhood.families[point]; }
};

/// A material update that did not converge: where.
class MaterialFailure : public std::runtime_error {
public:
    MaterialFailure(std::size_t point, const std::string& message) : std::runtime_error(message), point_(point) {}
    std::size_t point() const { return point_; }

private:
    std::size_t point_;
};

} // namespace periporo
