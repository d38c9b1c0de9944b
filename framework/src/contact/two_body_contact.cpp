// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Finds the pairs of points of two bodies that may touch.
#include "contact/two_body_contact.hpp"

#include "neighbourhood/cell_list.hpp"
#include "periporo/geometry.hpp"

#include <array>
#include <limits>

namespace periporo {
namespace {

/// The box of the points and images of a body, `reach` wider on all sides.
Bounds box_of(const Model& model, std::uint32_t body, double reach)
{
    Bounds box{Vector3::Constant(std::numeric_limits<double>::infinity()),
               Vector3::Constant(-std::numeric_limits<double>::infinity())};
    for (std::uint32_t c = 0; c < model.ends.size(); ++c)
        if (model.neighbourhood.body[c] == body) {
            box.lower = box.lower.cwiseMin(model.ends[c].x());
            box.upper = box.upper.cwiseMax(model.ends[c].x());
        }
    box.lower.array() -= reach;
    box.upper.array() += reach;
    return box;
}

bool lies_in(const Bounds& box, const Vector3& x)
{
    return (x.array() >= box.lower.array()).all() && (x.array() <= box.upper.array()).all();
}

} // namespace

void TwoBodyContact::find_candidates(const Model& model, double slack)
{
    const std::vector<std::uint32_t>& body = model.neighbourhood.body;
    const auto n = static_cast<std::uint32_t>(model.size());
    const double reach = reach_of_candidates(model, slack);
    // A point can touch the other body only within the box of that body, widened by the reach.
    std::array<Bounds, 2> boxes;
    for (std::size_t b = 0; b < 2; ++b)
        boxes[b] = box_of(model, assignment().bodies[b], reach);
    std::vector<std::uint32_t> near;
    std::vector<Vector3> positions;
    for (std::uint32_t c = 0; c < model.ends.size(); ++c) {
        if (!names(assignment(), body[c]) ||
            !lies_in(boxes[body[c] == assignment().bodies[0] ? 1 : 0], model.ends[c].x()))
            continue;
        near.push_back(c);
        positions.push_back(model.ends[c].x());
    }
    candidates_.clear(n);
    active_points_.clear();
    if (near.empty())
        return;
    const CellList cells(positions, reach);
    std::size_t next = 0; // of near, which begins with points, in their order
    for (std::uint32_t i = 0; i < n; ++i) {
        if (next < near.size() && near[next] == i) {
            cells.visit_near(positions[next], [&](std::uint32_t c) {
                if (body[near[c]] != body[i] && (positions[c] - positions[next]).squaredNorm() <= reach * reach)
                    candidates_.neighbours.push_back(near[c]);
            });
            ++next;
        }
        candidates_.first[i + 1] = candidates_.neighbours.size();
        if (candidates_.first[i + 1] > candidates_.first[i])
            active_points_.push_back(i);
    }
}

} // namespace periporo
