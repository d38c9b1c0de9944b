// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// A simple polygon in a plane: its area, what is in it and how far away its edges are.
#pragma once

#include "common/distance.hpp"
#include "common/exact.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <vector>

namespace periporo::geometry {

class Polygon {
public:
    using Point = CGAL::Exact_predicates_inexact_constructions_kernel::Point_2;
    using ExactPoint2 = ExactKernel::Point_2;

    /// @param coordinates x0, y0, x1, y1, ... of the corners [m], either way round
    /// @throws std::runtime_error unless the corners are those of a simple polygon, with what is wrong with which
    explicit Polygon(const std::vector<double>& coordinates);

    /// The corners, counter-clockwise.
    const std::vector<Point>& corners() const { return corners_; }
    Eigen::Vector2d lower() const { return lower_; }
    Eigen::Vector2d upper() const { return upper_; }
    /// [m2], exact but for the last rounding.
    double area() const;
    /// From its edges, with an outward direction in its plane; infinity for a place that is not finite.
    SignedDistance distance(double x, double y) const;
    bool is_convex() const { return convex_; }
    /// Calls visit(distance, unit direction away, both in the plane) for every edge nearer than `reach`, whichever side
    /// of it the place is on.
    template <class Visit>
    void for_each_edge(double x, double y, double reach, const Visit& visit) const
    {
        for (const Edge& edge : edges_) {
            const Eigen::Vector2d offset = Eigen::Vector2d(x, y) - edge.start;
            const double place = std::clamp(offset.dot(edge.direction), 0.0, edge.length);
            const Eigen::Vector2d away = offset - place * edge.direction;
            const double distance = away.norm();
            if (distance < reach)
                visit(distance, distance > 0.0 ? Eigen::Vector2d(away / distance)
                                               : Eigen::Vector2d(edge.direction.y(), -edge.direction.x()));
        }
    }
    /// The corners times `scale`, counter-clockwise.
    std::vector<ExactPoint2> exact_corners(const Exact& scale) const;

private:
    struct Edge {
        Eigen::Vector2d start;
        Eigen::Vector2d end;
        Eigen::Vector2d direction; ///< of length 1
        double length = 0.0;
    };

    std::vector<Point> corners_;
    std::vector<Edge> edges_;
    Eigen::Vector2d lower_;
    Eigen::Vector2d upper_;
    bool convex_ = false;
};

} // namespace periporo::geometry
