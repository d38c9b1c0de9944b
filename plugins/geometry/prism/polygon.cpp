// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The simple polygon, by CGAL's exact decisions.
#include "polygon.hpp"

#include <CGAL/Polygon_2_algorithms.h>
#include <CGAL/intersections.h>

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <stdexcept>

namespace periporo::geometry {

namespace {

using Point = Polygon::Point;
using Segment = CGAL::Exact_predicates_inexact_constructions_kernel::Segment_2;

constexpr int most_crossings_shown = 5;

std::vector<Point> points(const std::vector<double>& coordinates)
{
    if (coordinates.size() % 2 != 0)
        throw std::runtime_error(fmt::format("polygon holds {} numbers, and takes pairs x, y", coordinates.size()));
    if (coordinates.size() < 6)
        throw std::runtime_error(fmt::format("polygon has {} corners, and needs 3", coordinates.size() / 2));
    std::vector<Point> points;
    for (std::size_t i = 0; i < coordinates.size(); i += 2)
        points.emplace_back(coordinates[i], coordinates[i + 1]);
    return points;
}

std::string text(const Point& point)
{
    return fmt::format("({:.10g}, {:.10g})", point.x(), point.y());
}

/// Do edges i < j of n, s and t, have more in common than the corner between neighbours?
bool meet(const Segment& s, const Segment& t, std::size_t i, std::size_t j, std::size_t n)
{
    if (j == i + 1)
        return s.has_on(t.target()) || t.has_on(s.source());
    if (i == 0 && j == n - 1)
        return s.has_on(t.source()) || t.has_on(s.target());
    return CGAL::do_intersect(s, t);
}

/// A line for each of the first pairs of edges that meet.
std::string meeting_edges(const std::vector<Point>& corners)
{
    const std::size_t n = corners.size();
    const auto edge = [&](std::size_t i) { return Segment(corners[i], corners[(i + 1) % n]); };
    std::string lines;
    int count = 0;
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = i + 1; j < n; ++j) {
            const Segment s = edge(i);
            const Segment t = edge(j);
            if (!meet(s, t, i, j, n))
                continue;
            if (++count > most_crossings_shown)
                return lines + "\n  ...";
            lines += fmt::format("\n  edge {} from {} to {} meets edge {} from {} to {}", i, text(s.source()),
                                 text(s.target()), j, text(t.source()), text(t.target()));
        }
    return lines;
}

void require_simple(const std::vector<Point>& corners)
{
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const std::size_t next = (i + 1) % corners.size();
        if (corners[i] == corners[next])
            throw std::runtime_error(
                fmt::format("corners {} and {} of polygon, counted from 0, are both at {}; leave one out", i, next,
                            text(corners[i])));
    }
    if (!CGAL::is_simple_2(corners.begin(), corners.end()))
        throw std::runtime_error("the edges of polygon, counted from 0, must meet in the corners between neighbours "
                                 "only:" +
                                 meeting_edges(corners));
}

Eigen::Vector2d vector(const Point& point)
{
    return {point.x(), point.y()};
}

} // namespace

Polygon::Polygon(const std::vector<double>& coordinates) : corners_(points(coordinates))
{
    require_simple(corners_);
    if (CGAL::orientation_2(corners_.begin(), corners_.end()) == CGAL::CLOCKWISE)
        std::reverse(corners_.begin(), corners_.end());
    convex_ = CGAL::is_convex_2(corners_.begin(), corners_.end());
    lower_ = upper_ = vector(corners_.front());
    for (std::size_t i = 0; i < corners_.size(); ++i) {
        const Eigen::Vector2d start = vector(corners_[i]);
        const Eigen::Vector2d end = vector(corners_[(i + 1) % corners_.size()]);
        edges_.push_back({start, end, (end - start).normalized(), (end - start).norm()});
        lower_ = lower_.cwiseMin(start);
        upper_ = upper_.cwiseMax(start);
    }
}

std::vector<Polygon::ExactPoint2> Polygon::exact_corners(const Exact& scale) const
{
    std::vector<ExactPoint2> corners;
    for (const Point& corner : corners_)
        corners.emplace_back(scale * corner.x(), scale * corner.y());
    return corners;
}

double Polygon::area() const
{
    const std::vector<ExactPoint2> corners = exact_corners(1);
    return CGAL::to_double(CGAL::polygon_area_2(corners.begin(), corners.end(), ExactKernel()));
}

SignedDistance Polygon::distance(double x, double y) const
{
    const Eigen::Vector2d point(x, y);
    const Edge* nearest = nullptr;
    double along = 0.0; // the nearest edge, from its start to the nearest place on it
    double least = std::numeric_limits<double>::infinity();
    for (const Edge& edge : edges_) {
        const Eigen::Vector2d offset = point - edge.start;
        const double place = std::clamp(offset.dot(edge.direction), 0.0, edge.length);
        const double distance = (offset - place * edge.direction).norm();
        if (distance < least)
            least = distance, nearest = &edge, along = place;
    }
    if (nearest == nullptr)
        return {least, Vector3::UnitX()};
    const Vector3 beside(nearest->direction.y(), -nearest->direction.x(), 0.0);
    if (along > 0.0 && along < nearest->length)
        return {(point - nearest->start).dot(beside.head<2>()), beside};
    const auto side = CGAL::bounded_side_2(corners_.begin(), corners_.end(), Point(x, y));
    const double sign = side == CGAL::ON_UNBOUNDED_SIDE ? 1.0 : -1.0;
    const Eigen::Vector2d from_corner = point - (along > 0.0 ? nearest->end : nearest->start);
    return {sign * from_corner.norm(), unit_vector(sign * Vector3(from_corner.x(), from_corner.y(), 0.0), beside)};
}

} // namespace periporo::geometry
