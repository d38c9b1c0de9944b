// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Which points are next to which: families with their images, sub-horizons, and the accumulators of blocks.
#pragma once

#include "neighbourhood/block_accumulators.hpp"
#include "neighbourhood/families.hpp"
#include "neighbourhood/images.hpp"
#include "neighbourhood/sub_horizons.hpp"
#include "state/state.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace periporo {

/// A neighbour number names an end of bonds: a point, or points + m for image m. Values that bonds read from their
/// other end are fields over all ends, which fill_images() completes.
struct Neighbourhood {
    IsometryTable isometries;
    Families families;
    BlockAccumulators blocks;
    bool has_sub_horizons = true;       ///< does the force state in use sum over sub-horizons?
    SubHorizons sub_horizons;           ///< empty without
    std::vector<Vector3> positions;     ///< of the points, from which all this was found [m]
    std::vector<std::uint32_t> body;    ///< of each end
    std::vector<double> initial_volume; ///< V0 of each end [m3]

    /// Finds everything at the current positions.
    /// @throws what Families::find() throws
    void find(const State& state);
    /// The same for families that follow from those until now, see FamilyRule.
    /// @param closed pairs of points apart that have closed, sorted
    /// @return the families until now
    /// @throws what Families::find() throws; nothing has changed then
    Families renew(const State& state, std::span<const ClosedPair> closed);
    /// The same with families that a checkpoint kept, for the positions that they were found from.
    /// @throws std::runtime_error when they do not fit the points
    void restore(const State& state, const Families::Kept& kept);

    /// Ends of bonds: points, then images.
    std::size_t ends() const { return families.points() + families.images().size(); }

    /// Gives every image the value of its point.
    /// @param field one value for each end
    template <class Value>
    void fill_images(std::vector<Value>& field) const
    {
        const std::vector<Image>& images = families.images();
        for (std::size_t m = 0; m < images.size(); ++m)
            field[families.points() + m] = field[images[m].parent];
    }
    /// The value of the point that an end stands for: sums and marks of images go back to their points this way.
    /// @param field one value for each point
    template <class Value>
    Value& at_point(std::uint32_t end, std::vector<Value>& field) const
    {
        return field[families.parent(end)];
    }
    /// A vector at an end, rotated to the point that the end stands for.
    Vector3 rotated_to_point(std::uint32_t end, const Vector3& value) const
    {
        return isometries[families.isometry(end)].rotation.transpose() * value;
    }
    /// Adds a vector at an end to the point that the end stands for, as that point has it.
    /// @param field one vector for each point
    void add_to_point(std::uint32_t end, const Vector3& value, std::vector<Vector3>& field) const
    {
        at_point(end, field) += rotated_to_point(end, value);
    }

    std::size_t memory() const { return families.memory() + sub_horizons.memory() + blocks.memory(); } ///< [bytes]

    template <class Self, class Visit>
    static void members(Self& self, Visit& visit, std::size_t points)
    {
        visit("positions", exactly(self.positions, points));
        visit.part("images", self.isometries);
    }

private:
    Families families_of(const State& state, const Families* before, std::span<const ClosedPair> closed);
    void follow_families(const State& state);
};

} // namespace periporo
