// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// A contact law with the bodies and the surface that it acts between, and what kind of contact that is.
#pragma once

#include "periporo/contact.hpp"

#include <algorithm>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace periporo {

/// One contact law: between the named bodies and a rigid surface, which is an obstacle or the law's own; between two
/// different bodies, point against point or point against smoothed surface; or, where `bodies` names one body twice,
/// between its pieces that are apart, and between its detached points and all its points. Points of one family that
/// carry stress need no contact.
struct ContactAssignment {
    std::shared_ptr<const Contact> law;
    std::vector<std::uint32_t> bodies;
    std::optional<std::uint32_t> obstacle = {};     ///< number in the model
    std::optional<std::uint32_t> surface_body = {}; ///< the one of two bodies whose smoothed surface is touched
};

inline bool names(const ContactAssignment& assignment, std::uint32_t body)
{
    return std::find(assignment.bodies.begin(), assignment.bodies.end(), body) != assignment.bodies.end();
}

inline bool at_rigid_surface(const ContactAssignment& assignment)
{
    return assignment.obstacle || assignment.law->surface() != nullptr;
}

inline bool within_one_body(const ContactAssignment& assignment)
{
    return assignment.bodies.size() == 2 && assignment.bodies[0] == assignment.bodies[1];
}

} // namespace periporo
