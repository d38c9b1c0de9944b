// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
#include "assembly/body_fill.hpp"

#include "assembly/body_samples.hpp"
#include "periporo/first_exception.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <random>
#include <stdexcept>

namespace periporo {
namespace {

constexpr double relaxed_amplitude = 0.5; ///< of the start: anywhere in its own cell, so that the lattice is forgotten
constexpr double relaxed_move = 1e-3;     ///< largest move over the spacing of points that are at rest
constexpr int most_halvings = 30;         ///< what is left of a move is then below any spacing's last digits

/// Where a move out of a point of the body ends when it is halved until it ends in the body.
Vector3 moved_within(const Geometry& geometry, const Vector3& from, Vector3 move)
{
    for (int halvings = 0; halvings < most_halvings; ++halvings, move *= 0.5)
        if (geometry.contains(from + move))
            return from + move;
    return from;
}

void jitter(const Geometry& geometry, double largest_shift, std::int64_t seed, std::vector<Vector3>& points)
{
    // The generator is the same everywhere, the standard library's distributions are not.
    std::mt19937_64 generator(static_cast<std::uint64_t>(seed));
    std::vector<Vector3> shifts(points.size());
    for (Vector3& shift : shifts)
        for (double& component : shift)
            component = largest_shift * (static_cast<double>(generator() >> 11) * 0x1p-52 - 1.0);
    FirstException failure;
#pragma omp parallel for schedule(static)
    for (std::size_t p = 0; p < points.size(); ++p)
        failure.guard(p, [&] { points[p] = moved_within(geometry, points[p], shifts[p]); });
    failure.rethrow();
}

/// Moves every point to the centroid of its cell. Returns the largest move [m].
double move_to_centroids(const Geometry& geometry, const BodySamples& samples, std::vector<Vector3>& points)
{
    const VoronoiCells cells = samples.cells(points);
    double largest = 0.0;
    FirstException failure;
#pragma omp parallel for schedule(static) reduction(max : largest)
    for (std::size_t p = 0; p < points.size(); ++p)
        failure.guard(p, [&] {
            const Vector3 moved = moved_within(geometry, points[p], cells.centroids[p] - points[p]);
            largest = std::max(largest, (moved - points[p]).norm());
            points[p] = moved;
        });
    failure.rethrow();
    return largest;
}

std::vector<double> cell_volumes(const Geometry& geometry, const BodySamples& samples,
                                 const std::vector<Vector3>& points)
{
    std::vector<double> volumes;
    for (const std::int64_t count : samples.cells(points).samples)
        volumes.push_back(static_cast<double>(std::max<std::int64_t>(count, 1)));
    const double scale = geometry.volume() / std::accumulate(volumes.begin(), volumes.end(), 0.0);
    for (double& volume : volumes)
        volume *= scale;
    return volumes;
}

void check(const FillDescription& fill)
{
    if (!(fill.amplitude >= 0.0 && fill.amplitude < 0.5))
        throw std::invalid_argument(
            fmt::format("the amplitude of a jittered fill is at least 0 and below 0.5; it is {}", fill.amplitude));
}

} // namespace

PointCloud fill_body(const Geometry& geometry, double spacing, const FillDescription& fill,
                     const std::function<void(double)>& progress)
{
    check(fill);
    PointCloud cloud = fill.align == LatticeAxes::body ? geometry.fill(spacing) : fill_by_lattice(geometry, spacing);
    if (fill.kind == FillKind::lattice)
        return cloud;
    const bool is_relaxed = fill.kind == FillKind::relaxed;
    const double amplitude = is_relaxed ? relaxed_amplitude : fill.amplitude;
    jitter(geometry, amplitude * spacing, fill.seed, cloud.positions);
    const BodySamples samples(geometry, spacing);
    const std::int64_t iterations = is_relaxed ? fill.iterations : 0;
    for (std::int64_t n = 0; n < iterations; ++n) {
        if (progress)
            progress(static_cast<double>(n) / static_cast<double>(iterations));
        if (move_to_centroids(geometry, samples, cloud.positions) < relaxed_move * spacing)
            break;
    }
    if (progress)
        progress(1.0);
    cloud.volumes = cell_volumes(geometry, samples, cloud.positions);
    return cloud;
}

} // namespace periporo
