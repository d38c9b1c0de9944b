// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// In a block of points each is by itself, and lanes without a point cannot spoil anything.
#pragma once

#include "periporo/kit/block.hpp"

#include <limits>

namespace periporo::kit {

namespace detail {

/// Different points for three packs and one more, so that packs go through the law in pairs and alone.
inline std::vector<BlockPoint> mixed_points(const Material& material, const Range& range, Random& random)
{
    std::vector<BlockPoint> points;
    while (points.size() < 3 * pack_width + 1)
        for (const MaterialPoint& start : starting_points(material, range, random))
            for (const double size : range.strain_increments)
                points.push_back(block_point(start, random.tensor(size)));
    for (std::size_t n = points.size() - 1; n > 0; --n) // so that neighbours have nothing in common
        std::swap(points[n], points[static_cast<std::size_t>(random.number(0.0, static_cast<double>(n)))]);
    return points;
}

} // namespace detail

/// A point among others gives what it gives alone, with copies of itself as neighbours.
inline Faults check_lanes(const Material& material, const Range& range = {})
{
    Random random;
    const std::vector<BlockPoint> points = detail::mixed_points(material, range, random);
    Block block(material, points);
    if (const MaterialStatus status = block.update(range.time_step); !status.converged)
        return {sentence("lanes: a block of ordinary points fails at bond ", status.bond, " (",
                         reason_text(status.reason), ")")};
    for (std::size_t n = 0; n < points.size(); ++n) {
        Block alone(material, {points[n]});
        if (const MaterialStatus status = alone.update(range.time_step); !status.converged)
            return {sentence("lanes: bond ", n, " of a block fails alone (", reason_text(status.reason),
                             ") and not among the others")};
        const double scale = stress_scale(material, points[n].old.stress, points[n].strain_increment);
        const std::string fault =
            difference(block.values(n), alone.values(0), material, range.accuracy * scale, range.accuracy);
        if (!fault.empty())
            return {sentence("lanes: among other points, and not with copies of itself beside it, in bond ", n, " ",
                             fault)};
    }
    return {};
}

/// Lanes that are marked as inactive may hold anything, numbers or not.
inline Faults check_inactive_lanes(const Material& material, const Range& range = {})
{
    constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
    Random random;
    std::vector<BlockPoint> points = detail::mixed_points(material, range, random);
    Block clean(material, points);
    if (const MaterialStatus status = clean.update(range.time_step); !status.converged)
        return {sentence("inactive lanes: a block of ordinary points fails at bond ", status.bond, " (",
                         reason_text(status.reason), ")")};
    for (std::size_t n = 0; n < points.size(); ++n) {
        // every other lane, and the second pack as a whole
        points[n].active = n % 2 == 0 && n / pack_width != 1;
        if (points[n].active)
            continue;
        points[n].old.stress = SymmetricTensor<double>::isotropic(not_a_number);
        points[n].old.state.assign(points[n].old.state.size(), not_a_number);
        points[n].strain_increment = SymmetricTensor<double>::isotropic(not_a_number);
        points[n].suction = points[n].saturation = not_a_number;
    }
    Block spoilt(material, points);
    if (const MaterialStatus status = spoilt.update(range.time_step); !status.converged)
        return {sentence("inactive lanes: not-a-number in lanes without a point makes bond ", status.bond, " fail (",
                         reason_text(status.reason), ")")};
    for (std::size_t n = 0; n < points.size(); ++n) {
        if (!points[n].active)
            continue;
        const double scale = stress_scale(material, points[n].old.stress, points[n].strain_increment);
        const std::string fault =
            difference(spoilt.values(n), clean.values(n), material, range.accuracy * scale, range.accuracy);
        if (!fault.empty())
            return {sentence("inactive lanes: with not-a-number in lanes without a point, in bond ", n, " ", fault)};
    }
    return {};
}

} // namespace periporo::kit
