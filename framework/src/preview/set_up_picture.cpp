// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
#include "preview/set_up_picture.hpp"

#include "assembly/held_points.hpp"
#include "assembly/size_estimate.hpp"
#include "neighbourhood/cell_list.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace periporo {
namespace {

constexpr double hiding_distance = 1.3; ///< of a point that hides another, in spacings
constexpr double hiding_cosine = 0.7;   ///< within 45 degrees of an axis
constexpr std::size_t most_discs = 20000;
constexpr int obstacle_cells = 60; ///< along the longest side of what is shown of an obstacle
constexpr double azimuth = -60.0 * std::numbers::pi / 180.0;
constexpr double elevation = 25.0 * std::numbers::pi / 180.0;

// The palette of Okabe and Ito (2008), told apart with any colour vision.
constexpr std::array<const char*, 7> body_colours{"#0072b2", "#e69f00", "#009e73", "#cc79a7",
                                                  "#56b4e9", "#d55e00", "#f0e442"};
constexpr const char* obstacle_colour = "#9a9a9a";

/// Where a position goes on the paper [m], upwards positive, and how near it is.
struct Projection {
    Vector3 right, up, towards;
};
const Projection from_front{Vector3::UnitX(), Vector3::UnitZ(), -Vector3::UnitY()};
const Projection from_above{Vector3::UnitX(), Vector3::UnitY(), Vector3::UnitZ()};

Projection from_corner()
{
    const Vector3 towards(std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
                          std::sin(elevation));
    const Vector3 right(-std::sin(azimuth), std::cos(azimuth), 0.0);
    return {right, towards.cross(right), towards};
}

struct Disc {
    Vector3 position;
    double radius; ///< [m]
    SvgDrawing::Style style;
};

/// The part of the paper that a view has [pixels].
struct Frame {
    double left, top, width, height;
};

Bounds box_of(const Model& model)
{
    Bounds box{model.state.points.position.front(), model.state.points.position.front()};
    for (const Vector3& x : model.state.points.position) {
        box.lower = box.lower.cwiseMin(x);
        box.upper = box.upper.cwiseMax(x);
    }
    box.lower.array() -= 0.5 * model.state.spacing;
    box.upper.array() += 0.5 * model.state.spacing;
    return box;
}

std::array<Vector3, 8> corners_of(const Bounds& box)
{
    std::array<Vector3, 8> corners;
    for (std::size_t n = 0; n < corners.size(); ++n)
        for (Eigen::Index c = 0; c < 3; ++c)
            corners[n][c] = (n >> c & 1u) != 0 ? box.upper[c] : box.lower[c];
    return corners;
}

std::vector<Disc> discs_of_bodies(const BuiltModel& built, const CaseDescription& description)
{
    const Model& model = built.model;
    std::vector<std::uint8_t> is_held(model.size(), 0);
    for (const HeldDirection& held :
         held_directions(model, description, built.held_regions, description.stages.front()))
        is_held[held.point] = 1;
    const std::vector<std::uint32_t> visible = visible_points(model);
    const std::size_t stride = visible.size() / most_discs + 1;
    std::vector<Disc> discs;
    for (std::size_t n = 0; n < visible.size(); n += stride) {
        const std::uint32_t i = visible[n];
        SvgDrawing::Style style;
        style.fill = body_colours[model.state.points.body[i] % body_colours.size()];
        style.stroke = is_held[i] != 0 ? "#000000" : "#ffffff";
        style.width = is_held[i] != 0 ? 1.2 : 0.4;
        discs.push_back({model.state.points.position[i], 0.5 * model.state.spacing, style});
    }
    return discs;
}

/// Discs at the surface of an obstacle, as far as it lies in the box.
void add_obstacle(const Obstacle& obstacle, const Bounds& shown, std::vector<Disc>& discs)
{
    Bounds box = obstacle.geometry->bounds();
    box.lower = (box.lower + obstacle.shift).cwiseMax(shown.lower);
    box.upper = (box.upper + obstacle.shift).cwiseMin(shown.upper);
    const Vector3 size = box.upper - box.lower;
    const double cell = size.maxCoeff() / obstacle_cells;
    if (!(size.minCoeff() > 0.0))
        return;
    const Eigen::Array3i count = (size / cell).array().ceil().cast<int>();
    for (int k = 0; k < count.z(); ++k)
        for (int j = 0; j < count.y(); ++j)
            for (int i = 0; i < count.x(); ++i) {
                const Vector3 x = box.lower + cell * (Vector3(i, j, k) + Vector3::Constant(0.5));
                Vector3 normal;
                if (std::abs(obstacle.distance(x, normal)) <= 0.5 * cell)
                    discs.push_back({x, 0.6 * cell, {obstacle_colour, "none", 0.0, 0.25, false}});
            }
}

/// Ticks a round distance apart, five to ten of them.
double tick_distance(double length)
{
    const double power = std::pow(10.0, std::floor(std::log10(length)));
    for (const double part : {0.1, 0.2, 0.5, 1.0})
        if (length / (part * power) <= 10.0)
            return part * power;
    return power;
}

/// One view: a projection fitted into a frame.
class View {
public:
    View(SvgDrawing& drawing, const Projection& projection, const Bounds& box, const Frame& frame)
        : drawing_(drawing), projection_(projection), box_(box)
    {
        double low_x = 1e300, high_x = -1e300, low_y = 1e300, high_y = -1e300;
        for (const Vector3& corner : corners_of(box)) {
            low_x = std::min(low_x, corner.dot(projection.right)),
            high_x = std::max(high_x, corner.dot(projection.right));
            low_y = std::min(low_y, corner.dot(projection.up)), high_y = std::max(high_y, corner.dot(projection.up));
        }
        scale_ = std::min(frame.width / (high_x - low_x), frame.height / (high_y - low_y));
        origin_x_ = frame.left + 0.5 * (frame.width - scale_ * (high_x + low_x));
        origin_y_ = frame.top + 0.5 * (frame.height + scale_ * (high_y + low_y));
    }

    void draw(std::vector<Disc> discs)
    {
        std::ranges::stable_sort(discs, {}, [&](const Disc& disc) { return disc.position.dot(projection_.towards); });
        for (const Disc& disc : discs)
            drawing_.circle(x(disc.position), y(disc.position), scale_ * disc.radius, disc.style);
    }
    void line(const Vector3& from, const Vector3& to, const SvgDrawing::Style& style)
    {
        drawing_.line(x(from), y(from), x(to), y(to), style);
    }
    /// Along the lower edge of the box in one direction, with ticks and numbers in mm.
    void axis(int direction)
    {
        const bool upright = projection_.up.isApprox(Vector3::Unit(direction));
        line(box_.lower, at(direction, box_.upper[direction]), {"none", "#222222", 1.0, 1.0, false});
        const double step = tick_distance(box_.upper[direction] - box_.lower[direction]);
        for (double value = step * std::ceil(box_.lower[direction] / step - 1e-9);
             value <= box_.upper[direction] + 1e-9 * step; value += step) {
            const Vector3 place = at(direction, value);
            const double dx = upright ? -5.0 : 0.0, dy = upright ? 0.0 : 5.0;
            drawing_.line(x(place), y(place), x(place) + dx, y(place) + dy, {"none", "#222222", 1.0, 1.0, false});
            drawing_.text(x(place) + 1.6 * dx, y(place) + (upright ? 4.0 : 18.0),
                          fmt::format("{:.4g}", std::abs(value) < 1e-9 * step ? 0.0 : 1e3 * value), 11,
                          upright ? "end" : "middle");
        }
        const Vector3 end = at(direction, box_.upper[direction]);
        drawing_.text(x(end) + (upright ? 0.0 : 14.0), y(end) + (upright ? -10.0 : 18.0),
                      fmt::format("{} [mm]", "xyz"[direction]), 12, upright ? "middle" : "start");
    }
    void label(const Vector3& place, const std::string& text)
    {
        drawing_.text(x(place) + 4.0, y(place) - 6.0, text, 11);
    }

private:
    double x(const Vector3& position) const { return origin_x_ + scale_ * position.dot(projection_.right); }
    double y(const Vector3& position) const { return origin_y_ - scale_ * position.dot(projection_.up); }
    Vector3 at(int direction, double value) const
    {
        Vector3 place = box_.lower;
        place[direction] = value;
        return place;
    }

    SvgDrawing& drawing_;
    Projection projection_;
    Bounds box_;
    double scale_, origin_x_, origin_y_;
};

/// Mirrors and periodic sides as dashed lines, in the view that has `across` to the right and `upright` upwards.
void draw_planes(View& view, const Bounds& box, const CaseDescription& description, int across, int upright)
{
    const auto draw = [&](const PlaneDescription& plane, const std::string& text) {
        if (plane.axis != across && plane.axis != upright)
            return;
        Vector3 from = box.lower, to = box.lower;
        const int along = plane.axis == across ? upright : across;
        from[plane.axis] = to[plane.axis] = plane.offset;
        to[along] = box.upper[along];
        view.line(from, to, {"none", "#d55e00", 1.5, 1.0, true});
        view.label(to, text);
    };
    for (const BoundaryDescription& boundary : description.boundaries)
        draw(boundary.plane, name_of(boundary.kind));
    for (const PlaneDescription& roller : description.stages.front().rollers)
        if (roller.axis != cylinder_axis)
            draw(roller, "roller");
}

void draw_legend(SvgDrawing& drawing, const BuiltModel& built, const CaseDescription& description, double left,
                 double top)
{
    const Model& model = built.model;
    double line = top;
    for (std::size_t b = 0; b < model.state.bodies.size(); ++b) {
        std::size_t count = 0;
        double volume = 0.0, mass = 0.0;
        for (std::size_t i = 0; i < model.size(); ++i)
            if (model.state.points.body[i] == b)
                ++count, volume += model.state.points.volume[i], mass += model.state.points.mass[i];
        drawing.circle(left, line - 4.0, 6.0, {body_colours[b % body_colours.size()], "none", 0.0, 1.0, false});
        std::string text = fmt::format("body '{}' of '{}': {} points, {:.4g} m3, {:.4g} kg", model.state.bodies[b].name,
                                       description.bodies[b].material, count, volume, mass);
        const Vector3& v = description.bodies[b].velocity;
        if (!v.isZero(0.0))
            text += fmt::format(", velocity ({:.3g}, {:.3g}, {:.3g}) m/s", v.x(), v.y(), v.z());
        drawing.text(left + 14.0, line, text, 13);
        line += 20.0;
    }
    for (std::size_t o = 0; o < model.state.obstacles.size(); ++o) {
        drawing.circle(left, line - 4.0, 6.0, {obstacle_colour, "none", 0.0, 0.6, false});
        const Vector3& v = description.obstacles[o].velocity;
        drawing.text(left + 14.0, line,
                     fmt::format("obstacle '{}'{}", model.state.obstacles[o].name,
                                 v.isZero(0.0)
                                     ? ""
                                     : fmt::format(", moves with ({:.3g}, {:.3g}, {:.3g}) m/s", v.x(), v.y(), v.z())),
                     13);
        line += 20.0;
    }
    const Vector3 size = box_of(model).upper - box_of(model).lower;
    drawing.text(left, line,
                 fmt::format("bodies: {:.4g} x {:.4g} x {:.4g} mm; spacing {:.4g} mm; gravity ({:.3g}, {:.3g}, {:.3g}) "
                             "m/s2; black rims: motion prescribed",
                             1e3 * size.x(), 1e3 * size.y(), 1e3 * size.z(), 1e3 * model.state.spacing,
                             model.state.gravity.x(), model.state.gravity.y(), model.state.gravity.z()),
                 13);
}

} // namespace

std::vector<std::uint32_t> visible_points(const Model& model)
{
    const std::vector<Vector3>& positions = model.state.points.position;
    const double reach = hiding_distance * model.state.spacing;
    const CellList cells(positions, reach);
    std::vector<std::uint32_t> visible;
    for (std::uint32_t i = 0; i < model.size(); ++i) {
        unsigned sides = 0;
        cells.visit_near(positions[i], [&](std::uint32_t c) {
            const Vector3 apart = positions[c] - positions[i];
            const double distance = apart.norm();
            if (c == i || distance > reach || model.state.points.body[c] != model.state.points.body[i])
                return;
            for (int axis = 0; axis < 3; ++axis)
                if (std::abs(apart[axis]) > hiding_cosine * distance)
                    sides |= 1u << (2 * axis + (apart[axis] > 0.0 ? 1 : 0));
        });
        if (sides != 0b111111u)
            visible.push_back(i);
    }
    return visible;
}

SvgDrawing draw_set_up(const BuiltModel& built, const CaseDescription& description)
{
    const Bounds bodies = box_of(built.model);
    const double margin = 0.35 * (bodies.upper - bodies.lower).maxCoeff();
    const Bounds around{bodies.lower.array() - margin, bodies.upper.array() + margin};
    std::vector<Disc> discs;
    Bounds box = bodies;
    for (const Obstacle& obstacle : built.model.state.obstacles)
        add_obstacle(obstacle, around, discs);
    for (const Disc& disc : discs) {
        box.lower = box.lower.cwiseMin(disc.position);
        box.upper = box.upper.cwiseMax(disc.position);
    }
    const std::vector<Disc> points = discs_of_bodies(built, description);
    discs.insert(discs.end(), points.begin(), points.end());

    const double legend =
        20.0 * static_cast<double>(built.model.state.bodies.size() + built.model.state.obstacles.size() + 1);
    SvgDrawing drawing(1240.0, 740.0 + legend);
    drawing.text(30.0, 36.0, description.title, 20);
    View corner(drawing, from_corner(), box, {70.0, 80.0, 560.0, 580.0});
    corner.draw(discs);
    for (int direction = 0; direction < 3; ++direction)
        corner.axis(direction);
    View front(drawing, from_front, box, {740.0, 80.0, 440.0, 250.0});
    front.draw(discs);
    front.axis(0), front.axis(2);
    draw_planes(front, box, description, 0, 2);
    View above(drawing, from_above, box, {740.0, 410.0, 440.0, 250.0});
    above.draw(discs);
    above.axis(0), above.axis(1);
    draw_planes(above, box, description, 0, 1);
    draw_legend(drawing, built, description, 50.0, 740.0);
    return drawing;
}

void draw_case(const CaseDescription& description, const PluginRegistry& registry, const std::filesystem::path& file)
{
    Geometries geometries(description, registry);
    check_size(description, registry, geometries);
    draw_set_up(build_model(description, registry, geometries), description).save(file);
}

} // namespace periporo
