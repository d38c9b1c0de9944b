// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The nearest points of every two bodies.
#include "assembly/meeting_checks.hpp"

#include "case/refusal.hpp"
#include "neighbourhood/cell_list.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <utility>

namespace periporo {
namespace {

/// Two bodies whose nearest points are no farther apart touch: across a diagonal of their lattices too [spacings].
constexpr double touching = 1.5;

using Pair = std::pair<std::uint32_t, std::uint32_t>;

/// The least distance of points of two bodies, for bodies that touch [m].
std::map<Pair, double> touching_bodies(const Model& model)
{
    std::map<Pair, double> nearest;
    const Points& points = model.state.points;
    const double reach = touching * model.state.spacing;
    const CellList cells(points.position, reach);
    for (std::uint32_t i = 0; i < model.size(); ++i)
        cells.visit_near(points.position[i], [&](std::uint32_t j) {
            if (points.body[j] <= points.body[i])
                return;
            const double distance = (points.position[j] - points.position[i]).norm();
            if (distance > reach)
                return;
            const auto [found, is_new] = nearest.try_emplace({points.body[i], points.body[j]}, distance);
            if (!is_new)
                found->second = std::min(found->second, distance);
        });
    return nearest;
}

bool meet(const std::vector<ContactAssignment>& contacts, const Pair& pair)
{
    return std::ranges::any_of(contacts, [&](const ContactAssignment& contact) {
        const auto names = [&](std::uint32_t body) { return std::ranges::count(contact.bodies, body) > 0; };
        return contact.bodies.size() == 2 && names(pair.first) && names(pair.second);
    });
}

} // namespace

std::vector<std::string> check_meetings(const BuiltModel& built, const CaseDescription& description)
{
    std::vector<std::string> suspicions;
    if (built.model.state.bodies.size() < 2)
        return suspicions;
    for (const auto& [pair, distance] : touching_bodies(built.model)) {
        if (meet(built.contacts, pair))
            continue;
        const std::string& one = built.model.state.bodies[pair.first].name;
        const std::string& other = built.model.state.bodies[pair.second].name;
        suspicions.push_back(suspicion(
            description, "body." + other,
            fmt::format(
                "bodies '{0}' and '{1}' touch, their nearest points {2:.3g} spacings apart, and pass through each "
                "other: no [[contact]] has between = [\"{0}\", \"{1}\"]",
                one, other, distance / built.model.state.spacing)));
    }
    return suspicions;
}

} // namespace periporo
