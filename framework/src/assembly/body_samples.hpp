// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The inside of a body as samples, and the Voronoi cells of points within it.
#pragma once

#include "periporo/geometry.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace periporo {

/// What lies nearer to each point than to any other, within a body.
struct VoronoiCells {
    std::vector<std::int64_t> samples; ///< how many, of equal volume
    std::vector<Vector3> centroids;    ///< [m]; the point itself where it has no sample
};

/// Samples of a body, 512 in a cube of one spacing: the box around it is divided into blocks about half a spacing wide,
/// with 64 samples each. A block whose centre is on the same side of the surface as those of the blocks around it is
/// taken to lie there as a whole, so that parts of the body much thinner than half a spacing may be missed.
class BodySamples {
public:
    /// @param spacing of the material points that are to fill the body [m]
    /// @throws std::runtime_error when there are more blocks than memory.
    BodySamples(const Geometry& geometry, double spacing);

    /// Each sample belongs to its nearest point; the answer does not depend on the number of threads. Fastest where
    /// the points are about a spacing apart.
    VoronoiCells cells(std::span<const Vector3> points) const;

    /// Places of all samples [m].
    std::vector<Vector3> positions() const;

private:
    using Cell = Eigen::Matrix<long, 3, 1>;

    struct Block {
        Cell cell;
        std::uint64_t inside; ///< bit n: sample n is in the body
    };

    Vector3 position(const Cell& cell, const Vector3& within) const;
    Vector3 centre(const Cell& cell) const { return position(cell, Vector3::Constant(0.5)); }
    std::size_t index(const Cell& cell) const;
    bool is_at_surface(const Cell& cell, const std::vector<std::uint8_t>& centre_inside) const;
    std::uint64_t samples_inside(const Geometry& geometry, const Cell& cell) const;
    /// Blocks of one height that hold samples of the body.
    std::vector<Block> layer(const Geometry& geometry, long z, const std::vector<std::uint8_t>& centre_inside) const;

    Vector3 lower_; ///< corner of the box around the body [m]
    Vector3 width_; ///< of a block [m]
    Cell counts_;   ///< of blocks along each edge
    std::vector<Block> blocks_;
};

} // namespace periporo
