// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
#include "assembly/plane_checks.hpp"

#include "case/plane.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace periporo {
namespace {

// Of the distance that the first points of a fill have from a plane at which the body ends.
constexpr double nearest_sound = 0.9;       ///< tilted and curved surfaces are not in step with the lattice
constexpr double nearest_of_all = 0.5;      ///< below it a point and its image are nearer than half a spacing
constexpr double irregular_shift = 0.49;    ///< a relaxed point lies anywhere in its cell
constexpr double filled_to_the_side = 0.75; ///< of a spacing, between a side of a periodic cell and the first points

/// Half a spacing, less by how far the fill shifts points [m].
double first_distance(const Model& model, const FillDescription& fill)
{
    const double shift = fill.kind == FillKind::lattice    ? 0.0
                         : fill.kind == FillKind::jittered ? fill.amplitude
                                                           : irregular_shift;
    return (0.5 - shift) * model.state.spacing;
}

/// Is a place in the body, or less than half a spacing beside it?
bool is_about_inside(const Geometry& body, const Vector3& place, double spacing)
{
    if (body.contains(place))
        return true;
    for (int c = 0; c < 3; ++c)
        for (const double side : {-0.5 * spacing, 0.5 * spacing})
            if (body.contains(place + side * Vector3::Unit(c)))
                return true;
    return false;
}

Vector3 mirrored(const Vector3& x, const PlaneDescription& plane)
{
    Vector3 image = x;
    image[plane.axis] = 2.0 * plane.offset - x[plane.axis];
    return image;
}

/// The boundaries of a case against one of its bodies.
class BodyAtPlanes {
public:
    BodyAtPlanes(const BuiltModel& built, const CaseDescription& description, Geometries& geometries, std::size_t body)
        : model_(built.model), description_(description), cut_(built.cut_away[body]),
          geometry_(*geometries.of_body(body)), name_(model_.state.bodies[body].name),
          first_(first_distance(model_, description.bodies[body].fill))
    {
        for (std::size_t i = 0; i < model_.size(); ++i)
            if (model_.state.points.body[i] == body)
                kept_.push_back(model_.state.points.position[i]);
    }

    void check_cut_by_plane(const BoundaryDescription& boundary) const
    {
        const auto [beyond, deepest] = points_beyond(boundary.plane);
        if (beyond == 0)
            return;
        std::size_t unmatched = 0;
        for (const auto* points : {&kept_, &cut_})
            for (const Vector3& x : *points)
                unmatched += is_about_inside(geometry_, mirrored(x, boundary.plane), model_.state.spacing) ? 0 : 1;
        if (unmatched > 0)
            throw refusal(description_, boundary.key + ".plane",
                          fmt::format("{} of the {} points of body '{}' lie beyond the symmetry plane {}, up to {:.4g} "
                                      "m, and images do not stand for them: the body is not its own mirror image, {} "
                                      "of its points have no counterpart",
                                      beyond, kept_.size() + cut_.size(), name_, plane_text(boundary.plane), deepest,
                                      unmatched),
                          "the side of larger coordinates is computed: let the body end at the plane, or move the "
                          "plane to its end or its middle");
    }

    void check_cut_by_pair(const BoundaryDescription& boundary) const
    {
        const int axis = boundary.plane.axis;
        const double begin = boundary.plane.offset, end = begin + boundary.period;
        const auto outside =
            std::ranges::count_if(cut_, [&](const Vector3& x) { return x[axis] < begin || x[axis] >= end; });
        const auto [least, most] = range(axis);
        const double most_left_free = filled_to_the_side * model_.state.spacing;
        if (outside > 0 && (least - begin > most_left_free || end - most > most_left_free))
            throw refusal(
                description_, boundary.key + ".plane",
                fmt::format("{} of the {} points of body '{}' lie outside the periodic cell {:.4g} m <= {} < "
                            "{:.4g} m, and the body does not fill the cell from side to side: no images stand "
                            "for them",
                            outside, kept_.size() + cut_.size(), name_, begin, "xyz"[axis], end),
                "move the body into the cell, or make 'period' longer");
        if (least - begin + end - most < 2.0 * nearest_of_all * first_)
            throw refusal(
                description_, boundary.key + ".period",
                fmt::format("points of body '{}' at both sides of the periodic cell {:.4g} m <= {} < {:.4g} m "
                            "are only {:.4g} m from each other's images; they should be a spacing, {:.4g} m, "
                            "apart",
                            name_, begin, "xyz"[axis], end, least - begin + end - most, model_.state.spacing),
                "make 'period' a multiple of the spacing");
    }

    /// @param what the plane is, for the message
    void check_first_points(const PlaneDescription& plane, const std::string& key, const std::string& what,
                            std::vector<std::string>& suspicions) const
    {
        std::size_t too_near = 0;
        double nearest = std::numeric_limits<double>::infinity();
        for (const Vector3& x : kept_) {
            const double distance = std::abs(x[plane.axis] - plane.offset);
            too_near += distance < nearest_sound * first_ ? 1 : 0;
            nearest = std::min(nearest, distance);
        }
        if (too_near == 0)
            return;
        const auto [beyond, deepest] = points_beyond(plane);
        const std::string found =
            fmt::format("{} points of body '{}' lie on the {} {} or near to it, the nearest at {:.4g} m{}; its images "
                        "take up their "
                        "place a second time: first points lie half a spacing, {:.4g} m, from the plane",
                        too_near, name_, what, plane_text(plane), nearest,
                        beyond == 0 ? "" : fmt::format(", and {} lie beyond it, up to {:.4g} m", beyond, deepest),
                        0.5 * model_.state.spacing);
        if (nearest < nearest_of_all * first_)
            throw refusal(description_, key, found,
                          "move the plane or the body, or take a spacing that divides the length up to the plane");
        suspicions.push_back(suspicion(description_, key, found));
    }

private:
    /// How many of the points that are cut away lie beyond a plane, and how far [m].
    std::pair<std::size_t, double> points_beyond(const PlaneDescription& plane) const
    {
        std::pair<std::size_t, double> found{0, 0.0};
        for (const Vector3& x : cut_)
            if (x[plane.axis] < plane.offset) {
                ++found.first;
                found.second = std::max(found.second, plane.offset - x[plane.axis]);
            }
        return found;
    }

    std::pair<double, double> range(int axis) const
    {
        const auto along = [axis](const Vector3& x) { return x[axis]; };
        const auto [least, most] = std::ranges::minmax(kept_, {}, along);
        return {least[axis], most[axis]};
    }

    const Model& model_;
    const CaseDescription& description_;
    const std::vector<Vector3>& cut_;
    const Geometry& geometry_;
    std::string name_;
    double first_; ///< see first_distance() [m]
    std::vector<Vector3> kept_;
};

/// Rollers of the stages before the first motion, where points still lie about where they began.
void check_rollers_of_body(const BodyAtPlanes& body, const CaseDescription& description, Refusals& refusals,
                           std::vector<std::string>& suspicions)
{
    for (std::size_t s = 0; s < description.stages.size(); ++s) {
        if (description.stages[s].kind != StageType::quasi_static)
            return;
        const std::string key = fmt::format("stage.{}.rollers", s);
        for (const PlaneDescription& roller : description.stages[s].rollers)
            if (roller.axis != cylinder_axis)
                refusals.attempt(key, [&] { body.check_first_points(roller, key, "roller", suspicions); });
    }
}

} // namespace

void check_planes(const BuiltModel& built, const CaseDescription& description, Geometries& geometries,
                  Refusals& refusals, std::vector<std::string>& suspicions)
{
    for (std::size_t b = 0; b < built.model.state.bodies.size(); ++b) {
        const BodyAtPlanes body(built, description, geometries, b);
        for (const BoundaryDescription& boundary : description.boundaries) {
            const std::string key = boundary.key + ".plane";
            refusals.attempt(key, [&] {
                if (boundary.kind == ImageKind::periodic)
                    return body.check_cut_by_pair(boundary);
                body.check_cut_by_plane(boundary);
                body.check_first_points(boundary.plane, key, "symmetry plane", suspicions);
            });
        }
        check_rollers_of_body(body, description, refusals, suspicions);
    }
}

} // namespace periporo
