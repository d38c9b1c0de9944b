// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// What the tests of shapes have in common: rounding steps, moments of clouds, distances against samples of a surface.
#pragma once

#include "periporo/geometry.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>

namespace periporo::test {

inline double just_above(double value)
{
    return std::nextafter(value, std::numeric_limits<double>::infinity());
}

inline double just_below(double value)
{
    return std::nextafter(value, -std::numeric_limits<double>::infinity());
}

/// Checks that the axis-aligned region [lower, upper] is contained with its corners, edges and faces, and that nothing
/// is contained that lies the smallest possible step outside a face.
inline void check_closed_region(const Geometry& geometry, const Vector3& lower, const Vector3& upper)
{
    const Vector3 middle = (lower + upper) / 2;
    const std::array<Vector3, 3> levels{lower, middle, upper};
    for (const Vector3& x : levels)
        for (const Vector3& y : levels)
            for (const Vector3& z : levels)
                CHECK(geometry.contains(Vector3(x.x(), y.y(), z.z())));
    for (int direction = 0; direction < 3; ++direction) {
        Vector3 point = middle;
        point[direction] = just_below(lower[direction]);
        CHECK_FALSE(geometry.contains(point));
        point[direction] = just_above(upper[direction]);
        CHECK_FALSE(geometry.contains(point));
    }
}

/// Of points as masses of density 1.
struct Moments {
    double volume = 0.0;
    Vector3 centre = Vector3::Zero();
    Eigen::Matrix3d second = Eigen::Matrix3d::Zero(); ///< sum of V (x - centre)(x - centre)^T
};

inline Moments moments(const PointCloud& cloud)
{
    // In long double, which a hundred thousand equal volumes leave right to 1e-14, and double to 1e-11.
    long double volume = 0.0L;
    Eigen::Matrix<long double, 3, 1> first = Eigen::Matrix<long double, 3, 1>::Zero();
    for (std::size_t p = 0; p < cloud.positions.size(); ++p) {
        volume += cloud.volumes[p];
        first += static_cast<long double>(cloud.volumes[p]) * cloud.positions[p].cast<long double>();
    }
    Moments result;
    result.volume = static_cast<double>(volume);
    result.centre = (first / volume).cast<double>();
    for (std::size_t p = 0; p < cloud.positions.size(); ++p) {
        const Vector3 offset = cloud.positions[p] - result.centre;
        result.second += cloud.volumes[p] * offset * offset.transpose();
    }
    return result;
}

/// Places on a surface, each place of which is within `reach` of one of them.
struct SurfaceSamples {
    std::vector<Vector3> places;
    double reach = 0.0;

    /// Adds count x count places of the parallelogram corner + s u + t v, 0 <= s, t <= 1.
    void add(const Vector3& corner, const Vector3& u, const Vector3& v, int count)
    {
        for (int i = 0; i < count; ++i)
            for (int j = 0; j < count; ++j)
                places.push_back(corner + (i + 0.5) / count * u + (j + 0.5) / count * v);
        reach = std::max(reach, (u.norm() + v.norm()) / (2.0 * count));
    }
    /// Adds the six faces of a block.
    void add_block(const Vector3& corner, const std::array<Vector3, 3>& edges, int count)
    {
        for (std::size_t k = 0; k < 3; ++k)
            for (const Vector3& start : {corner, Vector3(corner + edges[k])})
                add(start, edges[(k + 1) % 3], edges[(k + 2) % 3], count);
    }
};

/// `count` places spread at random in the box around a geometry, widened by its size to all sides.
inline std::vector<Vector3> places_around(const Geometry& geometry, int count)
{
    const Bounds bounds = geometry.bounds();
    std::mt19937 generator(7);
    std::uniform_real_distribution<double> part(-1.0, 2.0);
    std::vector<Vector3> places;
    for (int i = 0; i < count; ++i)
        places.push_back(
            bounds.lower +
            Vector3(part(generator), part(generator), part(generator)).cwiseProduct(bounds.upper - bounds.lower));
    return places;
}

/// Checks the distance against the nearest of the samples of the surface, its sign against contains().
inline void check_distance(const Geometry& geometry, const SurfaceSamples& surface)
{
    REQUIRE(geometry.has_distance());
    const double roundings = 1e-13; // a few hundred, of lengths of order one
    for (const Vector3& place : places_around(geometry, 200)) {
        Vector3 normal;
        const double distance = geometry.signed_distance(place, normal);
        double nearest = std::numeric_limits<double>::infinity();
        for (const Vector3& sample : surface.places)
            nearest = std::min(nearest, (place - sample).squaredNorm());
        nearest = std::sqrt(nearest);
        CAPTURE(place.transpose());
        CHECK(std::abs(distance) <= nearest + roundings);
        CHECK(nearest <= std::abs(distance) + surface.reach);
        CHECK((distance <= 0.0) == geometry.contains(place));
    }
}

/// Checks that the normal is the gradient of the distance, by central differences, and of length 1. Places where the
/// differences to both sides tell of an edge of the distance in between are left out; they must be few.
inline void check_gradient(const Geometry& geometry)
{
    const double step = 1e-5;
    const auto at = [&](const Vector3& place) {
        Vector3 normal;
        return geometry.signed_distance(place, normal);
    };
    int checked = 0;
    const std::vector<Vector3> places = places_around(geometry, 400);
    for (const Vector3& place : places) {
        Vector3 normal;
        const double distance = geometry.signed_distance(place, normal);
        CHECK(normal.norm() == doctest::Approx(1.0).epsilon(1e-15));
        if (std::abs(distance) < 0.01) // where level surfaces around an edge are too strongly curved for the step
            continue;
        Vector3 gradient;
        bool smooth = true;
        for (int k = 0; k < 3; ++k) {
            const double ahead = at(place + step * Vector3::Unit(k));
            const double behind = at(place - step * Vector3::Unit(k));
            gradient[k] = (ahead - behind) / (2 * step);
            // A level surface of radius >= 0.01 bends the distance by step^2/0.01 at most, an edge by about the step.
            smooth = smooth && std::abs(ahead + behind - 2 * distance) <= 2 * step * step / 0.01;
        }
        if (!smooth)
            continue;
        ++checked;
        CAPTURE(place.transpose());
        // step^2/(6 x 0.01^2) from the third derivative of the distance, and rounding over the step
        CHECK((gradient - normal).norm() < 1e-6);
    }
    CHECK(checked > 0.9 * static_cast<double>(places.size()));
}

} // namespace periporo::test
