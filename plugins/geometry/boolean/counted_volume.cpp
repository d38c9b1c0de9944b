// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
#include "counted_volume.hpp"

#include "periporo/first_exception.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace periporo::geometry {

namespace {

constexpr int least_level = 4;          ///< 16 cells along each edge of the bounds
constexpr double relative_error = 1e-4; ///< at which the count ends
constexpr std::size_t most_samples = 20'000'000;
constexpr int edge_samples = 4;           ///< along each edge of a cell
constexpr std::int64_t cell_samples = 64; ///< of a cell
/// What n samples' worth of volume holds is missed by all of them with the chance exp(-n): 1 in 20 for three.
constexpr double unseen_samples = 3.0;

using Cell = Eigen::Matrix<std::uint32_t, 3, 1>;

/// G. L. Steele, D. Lea, C. H. Flood, "Fast splittable pseudorandom number generators", OOPSLA 2014: any seed gives a
/// sequence of its own, so that each cell has one, whoever counts it.
class SplitMix {
public:
    explicit SplitMix(std::uint64_t seed) : state_(seed) {}
    /// 0 <= number < 1
    double operator()()
    {
        std::uint64_t z = state_ += 0x9e3779b97f4a7c15;
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
        z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
        return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1p-53;
    }

private:
    std::uint64_t state_;
};

/// Cells of the bounds halved `level` times, and what is known of them.
class Count {
public:
    explicit Count(const CountedRegion& region) : region_(region) {}

    int level() const { return level_; }
    std::size_t open_cells() const { return open_.size(); }

    /// Halves the cells that are not decided yet and decides what can be.
    void halve()
    {
        ++level_;
        const Vector3 size = cell_size();
        const double radius = 0.5 * size.norm();
        std::vector<Cell> cells(8 * open_.size());
        std::vector<std::int8_t> known(cells.size()); // 1 inside, 0 outside, -1 open
        FirstException failure;                       // of an operand, which may be anybody's plugin
#pragma omp parallel for schedule(static)
        for (std::size_t n = 0; n < cells.size(); ++n)
            failure.guard(n, [&] {
                cells[n] = 2 * open_[n / 8] + Cell(n & 1, n >> 1 & 1, n >> 2 & 1);
                const std::optional<bool> inside = region_.decided(place(cells[n], Vector3::Constant(0.5)), radius);
                known[n] = static_cast<std::int8_t>(inside ? int{*inside} : -1);
            });
        failure.rethrow();
        open_.clear();
        for (std::size_t n = 0; n < cells.size(); ++n) {
            if (known[n] == 1)
                decided_volume_ += size.prod();
            else if (known[n] == -1)
                open_.push_back(cells[n]);
        }
    }

    /// Whole numbers make the sums the same in any order.
    CountedVolume sample() const
    {
        std::int64_t hits = 0;
        std::int64_t spread = 0;
        FirstException failure;
#pragma omp parallel for schedule(static) reduction(+ : hits, spread)
        for (std::size_t n = 0; n < open_.size(); ++n)
            failure.guard(n, [&] {
                const std::int64_t found = samples_inside(open_[n]);
                hits += found;
                spread += found * (cell_samples - found);
            });
        failure.rethrow();
        const double sample = cell_size().prod() / cell_samples;
        // The variance of a cell's part p is p (1 - p)/(n - 1).
        const double variance = static_cast<double>(spread) / (cell_samples - 1);
        const double unseen = open_.empty() ? 0.0 : unseen_samples;
        return {decided_volume_ + sample * static_cast<double>(hits),
                sample * std::max(2.0 * std::sqrt(variance), unseen)};
    }

private:
    Vector3 cell_size() const
    {
        return (region_.bounds.upper - region_.bounds.lower) * std::ldexp(1.0, -level_);
    }
    Vector3 place(const Cell& cell, const Vector3& within) const
    {
        return region_.bounds.lower + cell_size().cwiseProduct(cell.cast<double>() + within);
    }
    std::int64_t samples_inside(const Cell& cell) const
    {
        SplitMix random((std::uint64_t{cell.z()} << 42) ^ (std::uint64_t{cell.y()} << 21) ^ cell.x());
        std::int64_t found = 0;
        for (int z = 0; z < edge_samples; ++z)
            for (int y = 0; y < edge_samples; ++y)
                for (int x = 0; x < edge_samples; ++x) {
                    Vector3 within(x, y, z);
                    for (double& component : within)
                        component = (component + random()) / edge_samples;
                    found += region_.contains(place(cell, within)) ? 1 : 0;
                }
        return found;
    }

    const CountedRegion& region_;
    int level_ = 0;
    std::vector<Cell> open_{Cell::Zero()};
    double decided_volume_ = 0.0;
};

} // namespace

CountedVolume count_volume(const CountedRegion& region)
{
    Count count(region);
    CountedVolume counted;
    do {
        count.halve();
        if (count.level() < least_level)
            continue;
        if (count.level() > least_level && count.open_cells() * cell_samples > most_samples)
            break;
        counted = count.sample();
    } while (!(counted.volume > 0.0 && counted.error <= relative_error * counted.volume) && count.open_cells() > 0);
    return counted;
}

} // namespace periporo::geometry
