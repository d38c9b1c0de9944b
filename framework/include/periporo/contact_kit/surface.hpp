// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The rigid surface that a contact law brings along.
#pragma once

#include "periporo/contact_kit/range.hpp"
#include "periporo/kit/random.hpp"
#include "periporo/kit/text.hpp"

#include <cmath>

namespace periporo::kit {

/// The normal must have the length 1 and be the direction in which the distance grows, by 1 m a metre. Checked at
/// places within ten spacings of the origin.
inline Faults check_surface(const RigidSurface& surface, const ContactRange& range = {})
{
    constexpr double tolerance = 1e-4; // of a surface whose radius is a spacing, over 1e-4 of it
    Random random;
    for (int place = 0; place < 100; ++place) {
        const double size = 10.0 * range.spacing;
        const Vector3 x{size * random.number(), size * random.number(), size * random.number()};
        Vector3 normal, ignored;
        const double distance = surface.distance(x, normal);
        if (!(std::abs(normal.norm() - 1.0) <= 1e-9))
            return {sentence("surface: at (", x.x(), ", ", x.y(), ", ", x.z(), ") m the normal has the length ",
                             normal.norm())};
        const double way = 1e-4 * range.spacing;
        const double grown = surface.distance(x + way * normal, ignored) - distance;
        if (!(std::abs(grown - way) <= tolerance * way))
            return {sentence("surface: at (", x.x(), ", ", x.y(), ", ", x.z(), ") m the distance grows by ", grown,
                             " m over ", way, " m along the normal")};
    }
    return {};
}

} // namespace periporo::kit
