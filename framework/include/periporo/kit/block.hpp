// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// A block of different points, handed to a material as the operator does it.
#pragma once

#include "periporo/kit/points.hpp"

#include <cstdint>
#include <vector>

namespace periporo::kit {

/// A point on its way into a block.
struct BlockPoint {
    Values old;
    SymmetricTensor<double> strain_increment; ///< [-]
    double suction = 0.0;                     ///< [Pa]
    double saturation = 0.0;                  ///< [-]
    bool active = true;
};

inline BlockPoint block_point(const MaterialPoint& point, const SymmetricTensor<double>& strain_increment)
{
    return {values(point), strain_increment, point.suction(), point.saturation(), true};
}

class Block {
public:
    /// The last pack is filled up with inactive copies of the last point.
    Block(const Material& material, const std::vector<BlockPoint>& points)
        : material_(material), rows_(6 + material.state_variables().size()),
          packs_((points.size() + pack_width - 1) / pack_width), bonds_(packs_ * rows_), strains_(packs_ * 6),
          suction_(packs_), saturation_(packs_), active_(packs_, 0)
    {
        for (std::size_t n = 0; n < packs_ * pack_width; ++n) {
            const BlockPoint& point = points[std::min(n, points.size() - 1)];
            const std::size_t p = n / pack_width, lane = n % pack_width;
            store(point.old.stress, &bonds_[p * rows_], lane);
            for (std::size_t s = 0; s + 6 < rows_; ++s)
                bonds_[p * rows_ + 6 + s][lane] = point.old.state[s];
            store(point.strain_increment, &strains_[p * 6], lane);
            suction_[p][lane] = point.suction;
            saturation_[p][lane] = point.saturation;
            if (n < points.size() && point.active)
                active_[p] = static_cast<std::uint8_t>(active_[p] | 1u << lane);
        }
    }

    MaterialStatus update(double time_step, MaterialResponse response = MaterialResponse::full)
    {
        return material_.update(batch(time_step, response));
    }

    void initialize(double overconsolidation_ratio)
    {
        material_.initialize(batch(0.0, MaterialResponse::full), overconsolidation_ratio);
    }

    Values values(std::size_t point) const
    {
        const Pack* rows = &bonds_[point / pack_width * rows_];
        const auto row = [&](std::size_t r) { return double(rows[r][point % pack_width]); };
        Values result{{row(0), row(1), row(2), row(3), row(4), row(5)}, {}};
        for (std::size_t r = 6; r < rows_; ++r)
            result.state.push_back(row(r));
        return result;
    }

private:
    static void store(const SymmetricTensor<double>& tensor, Pack* rows, std::size_t lane)
    {
        std::size_t row = 0;
        for (const double component : components(tensor))
            rows[row++][lane] = component;
    }

    MaterialBatch batch(double time_step, MaterialResponse response)
    {
        MaterialBatch batch;
        batch.packs = packs_;
        batch.bonds = reinterpret_cast<double*>(bonds_.data()); // a pack is its lanes side by side
        batch.strain_increment = reinterpret_cast<const double*>(strains_.data());
        batch.suction = reinterpret_cast<const double*>(suction_.data());
        batch.saturation = reinterpret_cast<const double*>(saturation_.data());
        batch.active = active_.data();
        batch.time_step = time_step;
        batch.response = response;
        return batch;
    }

    const Material& material_;
    std::size_t rows_;
    std::size_t packs_;
    std::vector<Pack> bonds_, strains_, suction_, saturation_;
    std::vector<std::uint8_t> active_;
};

} // namespace periporo::kit
