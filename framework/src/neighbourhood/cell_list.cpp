// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
#include "neighbourhood/cell_list.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace periporo {
namespace {

// A few stray points far away must not ask for more cells than memory: cells grow until there are at most so many.
constexpr double most_cells_per_position = 8.0;

} // namespace

CellList::CellList(std::span<const Vector3> positions, double reach)
    : lower_(Vector3::Zero()), size_(reach * (1.0 + 1e-9)), near_squared_(size_ * size_)
{
    Vector3 upper = Vector3::Zero();
    if (!positions.empty()) {
        lower_ = upper = positions.front();
        for (const Vector3& x : positions) {
            lower_ = lower_.cwiseMin(x);
            upper = upper.cwiseMax(x);
        }
    }
    const Vector3 extent = upper - lower_;
    const auto cells = [&] {
        const Vector3 n = (extent / size_).array().floor() + 1.0;
        return n.prod();
    };
    while (cells() > most_cells_per_position * static_cast<double>(positions.size()) + 64.0)
        size_ *= 1.26;
    const Vector3 n = (extent / size_).array().floor() + 1.0;
    count_ = {static_cast<std::int64_t>(n.x()), static_cast<std::int64_t>(n.y()), static_cast<std::int64_t>(n.z())};

    const auto flat = [this](const Cell& c) {
        return static_cast<std::size_t>((c.z * count_.y + c.y) * count_.x + c.x);
    };
    std::vector<std::size_t> cell(positions.size());
    start_.assign(static_cast<std::size_t>(count_.x * count_.y * count_.z) + 1, 0);
    for (std::size_t p = 0; p < positions.size(); ++p) {
        Cell c = cell_of(positions[p]);
        c = {std::clamp<std::int64_t>(c.x, 0, count_.x - 1), std::clamp<std::int64_t>(c.y, 0, count_.y - 1),
             std::clamp<std::int64_t>(c.z, 0, count_.z - 1)};
        cell[p] = flat(c);
        ++start_[cell[p] + 1];
    }
    std::partial_sum(start_.begin(), start_.end(), start_.begin());
    order_.resize(positions.size());
    std::vector<std::size_t> next(start_.begin(), start_.end() - 1);
    for (std::size_t p = 0; p < positions.size(); ++p)
        order_[next[cell[p]]++] = static_cast<std::uint32_t>(p);
    for (std::size_t c = 0; c < 3; ++c) {
        coordinates_[c].resize(positions.size() + pack_width - 1);
        for (std::size_t n = 0; n < order_.size(); ++n)
            coordinates_[c][n] = positions[order_[n]][static_cast<Eigen::Index>(c)];
    }
}

CellList::Cell CellList::cell_of(const Vector3& position) const
{
    const Vector3 c = ((position - lower_) / size_).array().floor();
    return {static_cast<std::int64_t>(c.x()), static_cast<std::int64_t>(c.y()), static_cast<std::int64_t>(c.z())};
}

} // namespace periporo
