// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The nearest point of each of the samples of a block.
#pragma once

#include "neighbourhood/cell_list.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace periporo {

/// Finds the nearest points of the samples of one block after the other. A sample is no farther than the block's reach
/// from the centre. So where the centre's nearest point is d away, a sample has one within d + reach, and that lies
/// within d + 2 reach of the centre: only these candidates are compared sample by sample.
template <std::size_t samples>
class NearestPoints {
public:
    struct Candidate {
        std::uint32_t point;
        double distance_squared; ///< from the centre of the block [m2]
    };
    /// For each sample of a block, a place in the list of candidates.
    using Owners = std::array<std::size_t, samples>;

    /// @param places of the samples, from the centre of a block [m]
    /// @param spacing about that of the points [m]
    NearestPoints(std::span<const Vector3> points, const std::array<Vector3, samples>& places, double spacing)
        : points_(points)
    {
        for (const double spacings : {1.75, 4.0}) // most blocks need the first only
            searches_.push_back({spacings * spacing, CellList(points, spacings * spacing)});
        for (std::size_t s = 0; s < samples; ++s) {
            reach_ = std::max(reach_, places[s].norm());
            for (std::size_t c = 0; c < 3; ++c)
                place_[c][s] = places[s][static_cast<Eigen::Index>(c)];
        }
    }

    /// Points that may be the nearest of a sample, in an order that depends on the points only.
    void find_candidates(const Vector3& centre, std::vector<Candidate>& candidates) const
    {
        double least = std::numeric_limits<double>::infinity();
        const auto add = [&](std::uint32_t p) {
            candidates.push_back({p, (points_[p] - centre).squaredNorm()});
            least = std::min(least, candidates.back().distance_squared);
        };
        const auto limit = [&] { return std::sqrt(least) + 2.0 * reach_; };
        bool found = false;
        for (auto search = searches_.begin(); !found && search != searches_.end(); ++search) {
            candidates.clear();
            search->list.visit_near(centre, add);
            found = limit() < search->reach;
        }
        if (!found) {
            candidates.clear();
            for (std::uint32_t p = 0; p < points_.size(); ++p)
                add(p);
        }
        const double farthest = limit() * (1.0 + 1e-9); // rounding must leave out no nearest point
        std::erase_if(candidates, [&](const Candidate& c) { return c.distance_squared > farthest * farthest; });
    }

    /// Which candidate is the nearest of each sample.
    Owners owners(const Vector3& centre, const std::vector<Candidate>& candidates) const
    {
        Owners owner{};
        PerSample least;
        least.fill(std::numeric_limits<double>::infinity());
        for (std::size_t c = 0; c < candidates.size(); ++c) {
            const Vector3 offset = centre - points_[candidates[c].point];
            PerSample distance; // squared; short loops apart become packs, one loop of all does not
            for (std::size_t s = 0; s < samples; ++s) {
                const double x = offset.x() + place_[0][s];
                const double y = offset.y() + place_[1][s];
                const double z = offset.z() + place_[2][s];
                distance[s] = x * x + y * y + z * z;
            }
            for (std::size_t s = 0; s < samples; ++s)
                owner[s] = distance[s] < least[s] ? c : owner[s];
            for (std::size_t s = 0; s < samples; ++s)
                least[s] = std::min(distance[s], least[s]);
        }
        return owner;
    }

private:
    using PerSample = std::array<double, samples>;

    /// Finds all points within its reach.
    struct Search {
        double reach; ///< [m]
        CellList list;
    };

    std::span<const Vector3> points_;
    double reach_ = 0.0; ///< of the samples from the centre of a block [m]
    std::vector<Search> searches_;
    std::array<PerSample, 3> place_; ///< of the samples from the centre of a block, along each axis [m]
};

} // namespace periporo
