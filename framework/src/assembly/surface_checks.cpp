// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Compares rigid surfaces with the points of bodies and with each other.
#include "assembly/surface_checks.hpp"

#include "contact/rigid_contact_surface.hpp"
#include "neighbourhood/cell_list.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace periporo {
namespace {

constexpr double neighbouring = 1.1; ///< distance of points beside each other in a lattice, at most [spacings]
constexpr int places_between = 16;   ///< looked at on the way from a point to its neighbour
constexpr double same = 1e-6;        ///< distance of surfaces that are one [spacings]

/// Is a part of the way between two places inside the obstacle?
bool cuts(const Obstacle& obstacle, const Vector3& from, const Vector3& to)
{
    for (int n = 1; n < places_between; ++n) {
        const double part = static_cast<double>(n) / places_between;
        if (obstacle.geometry->contains(from + part * (to - from) - obstacle.shift))
            return true;
    }
    return false;
}

/// An obstacle that neither holds points of a body nor lies outside of it: a plate or a pin thinner than the spacing.
void check_thin_obstacle(const Model& model, const CaseDescription& description, const Obstacle& obstacle,
                         std::vector<std::string>& suspicions)
{
    const Points& points = model.state.points;
    std::vector<Vector3> near;
    std::vector<std::uint32_t> bodies;
    for (std::size_t i = 0; i < model.size(); ++i) {
        Vector3 normal;
        const double distance = obstacle.distance(points.position[i], normal);
        if (distance > 0.0 && distance < neighbouring * model.state.spacing) {
            near.push_back(points.position[i]);
            bodies.push_back(points.body[i]);
        }
    }
    if (near.empty())
        return;
    const double reach = neighbouring * model.state.spacing;
    const CellList cells(near, reach);
    std::size_t cut = 0;
    std::uint32_t first = 0, second = 0;
    for (std::uint32_t i = 0; i < near.size(); ++i)
        cells.visit_near(near[i], [&](std::uint32_t j) {
            if (j <= i || bodies[i] != bodies[j] || (near[i] - near[j]).norm() > reach ||
                !cuts(obstacle, near[i], near[j]))
                return;
            if (cut++ == 0)
                first = i, second = j;
        });
    if (cut == 0)
        return;
    const Vector3 middle = 0.5 * (near[first] + near[second]);
    suspicions.push_back(suspicion(
        description, "obstacle." + obstacle.name,
        fmt::format("obstacle '{}' lies between points of body '{}' that are neighbours ({} pairs, one of them at "
                    "({:.5g}, {:.5g}, {:.5g}) m): their bonds pass through it; cut the body there, or move the "
                    "obstacle",
                    obstacle.name, model.state.bodies[bodies[first]].name, cut, middle.x(), middle.y(), middle.z())));
}

/// How much farther from the points of a body the second surface is than the first: the same for all points when the
/// surfaces are parallel [m]. Not-a-number otherwise.
double distance_behind(const Model& model, std::uint32_t body, const RigidContactSurface& first,
                       const RigidContactSurface& second)
{
    const double round_off = same * model.state.spacing;
    double behind = std::numeric_limits<double>::quiet_NaN();
    for (std::size_t i = 0; i < model.size(); ++i) {
        Vector3 normal, other_normal;
        if (model.state.points.body[i] != body)
            continue;
        const Vector3& x = model.state.points.position[i];
        const double difference = second.distance(x, other_normal) - first.distance(x, normal);
        if ((normal - other_normal).norm() > same || std::abs(difference - behind) > round_off)
            return std::numeric_limits<double>::quiet_NaN();
        behind = difference;
    }
    return behind;
}

/// Two surfaces that laws bring along and that one body meets.
void compare_surfaces(const BuiltModel& built, const CaseDescription& description, std::size_t a, std::size_t b,
                      std::vector<std::string>& suspicions)
{
    const Model& model = built.model;
    const RigidContactSurface one(model, built.contacts[a]), other(model, built.contacts[b]);
    const std::uint32_t body = built.contacts[a].bodies[0];
    const double behind = distance_behind(model, body, one, other);
    if (std::isnan(behind))
        return;
    const std::string key = fmt::format("contact.{}", b);
    const std::string& name = model.state.bodies[body].name;
    if (std::abs(behind) < same * model.state.spacing)
        throw refusal(
            description, key,
            fmt::format("the surface of contact {} is that of contact {}: body '{}' would feel both", b, a, name),
            "keep one of them");
    const std::size_t hidden = behind > 0.0 ? b : a;
    suspicions.push_back(suspicion(
        description, fmt::format("contact.{}", hidden),
        fmt::format("the surface of contact {} lies {:.4g} m behind that of contact {}: body '{}' never meets it",
                    hidden, std::abs(behind), hidden == b ? a : b, name)));
}

} // namespace

void check_rigid_surfaces(const BuiltModel& built, const CaseDescription& description, Refusals& refusals,
                          std::vector<std::string>& suspicions)
{
    for (const Obstacle& obstacle : built.model.state.obstacles)
        if (obstacle.present)
            check_thin_obstacle(built.model, description, obstacle, suspicions);
    const auto own_surface = [&](std::size_t c) {
        return !built.contacts[c].obstacle && built.contacts[c].law->surface() != nullptr;
    };
    for (std::size_t b = 1; b < built.contacts.size(); ++b)
        for (std::size_t a = 0; a < b; ++a)
            if (own_surface(a) && own_surface(b) && built.contacts[a].bodies == built.contacts[b].bodies)
                refusals.attempt(fmt::format("contact.{}", b),
                                 [&] { compare_surfaces(built, description, a, b, suspicions); });
}

} // namespace periporo
