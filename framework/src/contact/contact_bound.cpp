// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The sharpest contacts that points may have, whether they touch or not.
#include "contact/contact_bound.hpp"

#include <cmath>
#include <limits>

namespace periporo {
namespace {

struct Range {
    double least = std::numeric_limits<double>::infinity();
    double largest = 0.0;

    void add(double value)
    {
        least = std::min(least, value);
        largest = std::max(largest, value);
    }
};

double frequency(const Contact& law, const ContactPair& pair)
{
    return std::sqrt(sharpness(pair, slopes(law, pair)));
}

} // namespace

double sharpest_at_rigid_surface(const Model& model, const ContactAssignment& assignment)
{
    const Points& points = model.state.points;
    double largest = 0.0;
    for (std::size_t i = 0; i < model.size(); ++i)
        if (names(assignment, points.body[i]))
            largest =
                std::max(largest, frequency(*assignment.law, {0.0, 0.0, points.volume[i], 0.0, points.mass[i], 0.0}));
    return largest;
}

double sharpest_between_points(const Model& model, const ContactAssignment& assignment)
{
    const Points& points = model.state.points;
    std::array<Range, 2> volumes, masses;
    for (std::size_t i = 0; i < model.size(); ++i)
        for (std::size_t side = 0; side < 2; ++side)
            if (points.body[i] == assignment.bodies[side]) {
                volumes[side].add(points.volume[i]);
                masses[side].add(points.mass[i]);
            }
    double largest = 0.0;
    for (const double a : {volumes[0].least, volumes[0].largest})
        for (const double b : {volumes[1].least, volumes[1].largest})
            largest = std::max(largest, frequency(*assignment.law, {0.0, 0.0, a, b, masses[0].least, masses[1].least}));
    return largest;
}

} // namespace periporo
