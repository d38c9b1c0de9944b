// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
#include "neighbourhood/images.hpp"

#include <algorithm>
#include <deque>
#include <fmt/format.h>
#include <limits>
#include <stdexcept>

namespace periporo {
namespace {

constexpr std::size_t most_isometries = 4096;

bool same(const Isometry& a, const Isometry& b, double length)
{
    return (a.rotation - b.rotation).cwiseAbs().maxCoeff() < 1e-9 &&
           (a.translation - b.translation).cwiseAbs().maxCoeff() < 1e-9 * length;
}

/// Distance between the box and its image, from below: the image of a box is bounded by an axis-aligned box.
double gap(const Isometry& isometry, const Vector3& lower, const Vector3& upper)
{
    const Vector3 centre = isometry.point(0.5 * (lower + upper));
    const Vector3 half = isometry.rotation.cwiseAbs() * (0.5 * (upper - lower));
    const Vector3 separation = (lower - (centre + half)).cwiseMax((centre - half) - upper).cwiseMax(Vector3::Zero());
    return separation.norm();
}

} // namespace

Isometry Isometry::reflection(int axis, double offset)
{
    Isometry isometry;
    isometry.rotation(axis, axis) = -1.0;
    isometry.translation(axis) = 2.0 * offset;
    return isometry;
}

Isometry Isometry::shift(int axis, double distance)
{
    Isometry isometry;
    isometry.translation(axis) = distance;
    return isometry;
}

IsometryTable::IsometryTable()
{
    isometries_.emplace_back();
    inverses_.push_back(0);
}

void IsometryTable::set_generators(std::vector<Isometry> generators)
{
    generators_ = std::move(generators);
    const std::size_t given = generators_.size();
    for (std::size_t g = 0; g < given; ++g) {
        const Isometry inverse = generators_[g].inverse();
        if (!same(inverse, generators_[g], 1.0))
            generators_.push_back(inverse);
    }
}

std::optional<std::uint32_t> IsometryTable::find(const Isometry& isometry) const
{
    for (std::uint32_t n = 0; n < isometries_.size(); ++n)
        if (same(isometries_[n], isometry, 1.0))
            return n;
    return std::nullopt;
}

std::uint32_t IsometryTable::number_of(const Isometry& isometry)
{
    const auto look_up = [this](const Isometry& wanted) {
        if (const std::optional<std::uint32_t> known = find(wanted))
            return *known;
        isometries_.push_back(wanted);
        inverses_.push_back(std::numeric_limits<std::uint32_t>::max());
        return static_cast<std::uint32_t>(isometries_.size() - 1);
    };
    const std::uint32_t number = look_up(isometry);
    if (inverses_[number] == std::numeric_limits<std::uint32_t>::max()) {
        const std::uint32_t inverse = look_up(isometry.inverse());
        inverses_[number] = inverse;
        inverses_[inverse] = number;
    }
    return number;
}

std::vector<std::uint32_t> IsometryTable::active(const Vector3& lower, const Vector3& upper, double reach)
{
    std::vector<std::uint32_t> found;
    std::deque<std::uint32_t> frontier{0};
    std::vector<bool> seen(isometries_.size(), false);
    seen[0] = true;
    while (!frontier.empty()) {
        const Isometry current = isometries_[frontier.front()];
        frontier.pop_front();
        for (const Isometry& generator : generators_) {
            const Isometry product = generator.after(current);
            if (gap(product, lower, upper) > reach)
                continue;
            const std::uint32_t number = number_of(product);
            seen.resize(isometries_.size(), false);
            if (seen[number])
                continue;
            seen[number] = true;
            found.push_back(number);
            frontier.push_back(number);
            if (found.size() > most_isometries)
                throw std::runtime_error(fmt::format(
                    "symmetry planes and periodic pairs make more than {} images of points in the box from ({:.4g}, "
                    "{:.4g}, {:.4g}) to ({:.4g}, {:.4g}, {:.4g}) m: points have run far away, planes are too close "
                    "together for the box, or they are neither parallel nor perpendicular to each other",
                    most_isometries, lower.x(), lower.y(), lower.z(), upper.x(), upper.y(), upper.z()));
        }
    }
    return found;
}

void IsometryTable::resume()
{
    const auto is_isometry = [](const Isometry& isometry) {
        return (isometry.rotation * isometry.rotation.transpose()).isIdentity(1e-9);
    };
    if (isometries_.empty() || !same(isometries_.front(), {}, 1.0) || !std::ranges::all_of(isometries_, is_isometry))
        throw std::runtime_error("the table of isometries has others among them");
    const std::size_t count = isometries_.size();
    inverses_.assign(count, std::numeric_limits<std::uint32_t>::max());
    for (std::size_t n = 0; n < count; ++n)
        number_of(Isometry(isometries_[n]));
}

std::vector<Image> find_images(std::span<const Vector3> positions, IsometryTable& isometries, double reach)
{
    std::vector<Image> images;
    if (positions.empty())
        return images;
    Vector3 lower = positions.front();
    Vector3 upper = positions.front();
    for (const Vector3& x : positions) {
        lower = lower.cwiseMin(x);
        upper = upper.cwiseMax(x);
    }
    const double margin = reach * (1.0 + 1e-9);
    std::vector<std::uint32_t> active = isometries.active(lower, upper, margin);
    std::sort(active.begin(), active.end());
    for (const std::uint32_t number : active) {
        const Isometry& isometry = isometries[number];
        for (std::size_t p = 0; p < positions.size(); ++p) {
            const Vector3 x = isometry.point(positions[p]);
            if (((x - lower).array() >= -margin).all() && ((upper - x).array() >= -margin).all())
                images.push_back({static_cast<std::uint32_t>(p), number});
        }
    }
    return images;
}

} // namespace periporo
