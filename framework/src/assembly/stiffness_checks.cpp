// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Counts active bonds body by body.
#include "assembly/stiffness_checks.hpp"

#include "case/refusal.hpp"

#include <fmt/format.h>

namespace periporo {
namespace {

/// Part of the bonds of a body that may be inactive. Of an intact lattice at least two points thick none is.
constexpr double most_inactive = 0.2;
/// Single grains and small clumps of loose points are meant as such.
constexpr std::size_t least_points = 8;

struct Bonds {
    std::size_t points = 0, detached = 0, all = 0, inactive = 0;
};

} // namespace

std::vector<std::string> check_stiffness(const Model& model, const CaseDescription& description)
{
    std::vector<Bonds> bodies(model.state.bodies.size());
    for (std::size_t i = 0; i < model.size(); ++i) {
        Bonds& body = bodies[model.state.points.body[i]];
        ++body.points;
        body.detached += model.result.detached[i];
        body.all += model.neighbourhood.families[i].count;
        body.inactive += model.result.inactive_bonds[i];
    }
    std::vector<std::string> suspicions;
    for (std::size_t b = 0; b < bodies.size(); ++b) {
        const Bonds& body = bodies[b];
        if (body.points < least_points ||
            static_cast<double>(body.inactive) <= most_inactive * static_cast<double>(body.all))
            continue;
        suspicions.push_back(suspicion(
            description, "body." + model.state.bodies[b].name,
            fmt::format(
                "{} of the {} bonds of body '{}' carry no stress from the start, and {} of its {} points have no "
                "bond that does: a sub-horizon must reach points on all sides; take a horizon of at least 1.5 "
                "spacings (it is {:.4g}) and a body at least two points thick",
                body.inactive, body.all, model.state.bodies[b].name, body.detached, body.points,
                model.state.horizon / model.state.spacing)));
    }
    return suspicions;
}

} // namespace periporo
