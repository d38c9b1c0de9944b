// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
#include "assembly/body_samples.hpp"

#include "assembly/nearest_points.hpp"
#include "periporo/first_exception.hpp"

#include <fmt/format.h>

#include <array>
#include <stdexcept>

namespace periporo {
namespace {

using Cell = Eigen::Matrix<long, 3, 1>;

constexpr long divisions = 4; ///< along each edge of a block, with one sample in each division
constexpr std::size_t block_samples = divisions * divisions * divisions;
constexpr long planes = divisions * divisions; ///< across each edge of a block, in which the samples stand
constexpr double most_blocks = 4e9;            ///< of one byte each while the body is sampled

/// In which planes across x, y and z each sample of a block stands. Rows and columns of samples are shifted against
/// each other, so that they see the place of a face four times as sharply as samples in four planes would.
const std::array<Cell, block_samples>& sample_planes()
{
    static const std::array<Cell, block_samples> all = [] {
        std::array<Cell, block_samples> planes_of;
        std::size_t count = 0;
        for (long z = 0; z < divisions; ++z)
            for (long y = 0; y < divisions; ++y)
                for (long x = 0; x < divisions; ++x)
                    planes_of[count++] = {divisions * x + (y + z) % divisions, divisions * y + (z + x) % divisions,
                                          divisions * z + (x + y) % divisions};
        return planes_of;
    }();
    return all;
}

/// From 0 to 1 along each edge of a block.
Vector3 place_in_block(const Vector3& plane)
{
    return (plane + Vector3::Constant(0.5)) / planes;
}

/// Samples of a point in whole numbers, whose sums do not depend on their order.
struct Share {
    std::int64_t count = 0;
    std::array<std::int64_t, 3> sum{}; ///< of the planes in which they stand, counted from the body's lower corner

    void add(const Cell& plane)
    {
        ++count;
        for (std::size_t c = 0; c < 3; ++c)
            sum[c] += plane[static_cast<Eigen::Index>(c)];
    }
    /// While other threads add, too.
    void add_shared(const Share& other)
    {
#pragma omp atomic
        count += other.count;
        for (std::size_t c = 0; c < 3; ++c) {
#pragma omp atomic
            sum[c] += other.sum[c];
        }
    }
    Vector3 mean_plane() const
    {
        return Vector3(static_cast<double>(sum[0]), static_cast<double>(sum[1]), static_cast<double>(sum[2])) /
               static_cast<double>(count);
    }
};

} // namespace

BodySamples::BodySamples(const Geometry& geometry, double spacing)
{
    const Bounds bounds = geometry.bounds();
    const Vector3 extent = bounds.upper - bounds.lower;
    // Whole blocks in the box: those of a box-shaped body lie inside as a whole.
    const Vector3 counts = (extent / (0.5 * spacing)).array().ceil().max(1.0);
    if (!(counts.prod() < most_blocks))
        throw std::runtime_error(fmt::format("a spacing of {:.6g} m is too fine for Voronoi cells in the box around "
                                             "the geometry, {:.6g} x {:.6g} x {:.6g} m; a lattice would do",
                                             spacing, extent.x(), extent.y(), extent.z()));
    lower_ = bounds.lower;
    width_ = extent.cwiseQuotient(counts);
    counts_ = counts.cast<long>();

    std::vector<std::uint8_t> centre_inside(static_cast<std::size_t>(counts_.prod()));
    FirstException failure;
#pragma omp parallel for schedule(dynamic)
    for (long z = 0; z < counts_.z(); ++z)
        failure.guard(static_cast<std::size_t>(z), [&] {
            for (long y = 0; y < counts_.y(); ++y)
                for (long x = 0; x < counts_.x(); ++x)
                    centre_inside[index({x, y, z})] = geometry.contains(centre({x, y, z})) ? 1 : 0;
        });
    failure.rethrow();
    std::vector<std::vector<Block>> layers(static_cast<std::size_t>(counts_.z()));
#pragma omp parallel for schedule(dynamic)
    for (std::size_t z = 0; z < layers.size(); ++z)
        failure.guard(z, [&] { layers[z] = layer(geometry, static_cast<long>(z), centre_inside); });
    failure.rethrow();
    for (const std::vector<Block>& layer : layers)
        blocks_.insert(blocks_.end(), layer.begin(), layer.end());
}

std::vector<BodySamples::Block> BodySamples::layer(const Geometry& geometry, long z,
                                                   const std::vector<std::uint8_t>& centre_inside) const
{
    std::vector<Block> blocks;
    for (long y = 0; y < counts_.y(); ++y)
        for (long x = 0; x < counts_.x(); ++x) {
            const Cell cell(x, y, z);
            const std::uint64_t inside = is_at_surface(cell, centre_inside) ? samples_inside(geometry, cell)
                                         : centre_inside[index(cell)] != 0  ? ~std::uint64_t{0}
                                                                            : 0;
            if (inside != 0)
                blocks.push_back({cell, inside});
        }
    return blocks;
}

Vector3 BodySamples::position(const Cell& cell, const Vector3& within) const
{
    return lower_ + width_.cwiseProduct(cell.cast<double>() + within);
}

std::size_t BodySamples::index(const Cell& cell) const
{
    return static_cast<std::size_t>((cell.z() * counts_.y() + cell.y()) * counts_.x() + cell.x());
}

bool BodySamples::is_at_surface(const Cell& cell, const std::vector<std::uint8_t>& centre_inside) const
{
    if ((cell.array() == 0).any() || (cell.array() == counts_.array() - 1).any())
        return true;
    for (long z = -1; z <= 1; ++z)
        for (long y = -1; y <= 1; ++y)
            for (long x = -1; x <= 1; ++x)
                if (centre_inside[index(cell + Cell(x, y, z))] != centre_inside[index(cell)])
                    return true;
    return false;
}

std::uint64_t BodySamples::samples_inside(const Geometry& geometry, const Cell& cell) const
{
    std::uint64_t inside = 0;
    for (std::size_t s = 0; s < block_samples; ++s) {
        const Vector3 within = place_in_block(sample_planes()[s].cast<double>());
        inside |= static_cast<std::uint64_t>(geometry.contains(position(cell, within))) << s;
    }
    return inside;
}

VoronoiCells BodySamples::cells(std::span<const Vector3> points) const
{
    std::array<Vector3, block_samples> places;
    for (std::size_t s = 0; s < block_samples; ++s)
        places[s] = width_.cwiseProduct(place_in_block(sample_planes()[s].cast<double>()) - Vector3::Constant(0.5));
    const NearestPoints nearest(points, places, 2.0 * width_.maxCoeff());
    std::vector<Share> shares(points.size());
    FirstException failure;
#pragma omp parallel
    {
        std::vector<decltype(nearest)::Candidate> candidates;
        std::vector<Share> found;
#pragma omp for schedule(dynamic, 256)
        for (std::size_t b = 0; b < blocks_.size(); ++b)
            failure.guard(b, [&] {
                const Block& block = blocks_[b];
                nearest.find_candidates(centre(block.cell), candidates);
                const auto owners = nearest.owners(centre(block.cell), candidates);
                found.assign(candidates.size(), {});
                for (std::size_t s = 0; s < block_samples; ++s)
                    if ((block.inside >> s & 1u) != 0)
                        found[owners[s]].add(planes * block.cell + sample_planes()[s]);
                for (std::size_t c = 0; c < candidates.size(); ++c)
                    if (found[c].count > 0)
                        shares[candidates[c].point].add_shared(found[c]);
            });
    }
    failure.rethrow();
    VoronoiCells cells;
    for (std::size_t p = 0; p < points.size(); ++p) {
        cells.samples.push_back(shares[p].count);
        cells.centroids.push_back(shares[p].count > 0 ? position(Cell::Zero(), place_in_block(shares[p].mean_plane()))
                                                      : points[p]);
    }
    return cells;
}

std::vector<Vector3> BodySamples::positions() const
{
    std::vector<Vector3> all;
    for (const Block& block : blocks_)
        for (std::size_t s = 0; s < block_samples; ++s)
            if ((block.inside >> s & 1u) != 0)
                all.push_back(position(block.cell, place_in_block(sample_planes()[s].cast<double>())));
    return all;
}

} // namespace periporo
