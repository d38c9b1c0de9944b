// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Finds the ends that the bonds of each block reach.
#include "neighbourhood/block_accumulators.hpp"

#include "periporo/first_exception.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

namespace periporo {

void BlockAccumulators::find(const Families& families)
{
    const std::size_t n = families.points();
    const std::size_t blocks = (n + block_size - 1) / block_size;
    of_neighbours_.assign(families.packs() * pack_width, 0);
    first_contribution_.assign(n + 1, 0);
    std::vector<std::vector<std::uint32_t>> ends_of(blocks);
    FirstException failure;
#pragma omp parallel
    {
        constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
        std::vector<std::uint32_t> accumulator; // of an end, in the block
        failure.guard_set_up([&] { accumulator.assign(n + families.images().size(), none); });
        const auto find_ends = [&](std::size_t block) {
            std::vector<std::uint32_t>& ends = ends_of[block];
            const auto first = static_cast<std::uint32_t>(first_point(block));
            const auto end = static_cast<std::uint32_t>(end_point(block));
            for (std::uint32_t i = first; i < end; ++i) {
                accumulator[i] = i - first;
                ends.push_back(i);
            }
            for (std::uint32_t i = first; i < end; ++i) {
                const FamilyView family = families[i];
                std::uint16_t* of_neighbours = of_neighbours_.data() + family.first_pack * pack_width;
                for (std::size_t b = 0; b < family.count; ++b) {
                    std::uint32_t& at = accumulator[family.neighbours[b]];
                    if (at == none) {
                        at = static_cast<std::uint32_t>(ends.size());
                        ends.push_back(family.neighbours[b]);
                    }
                    of_neighbours[b] = static_cast<std::uint16_t>(at);
                }
            }
            for (const std::uint32_t end_of_bonds : ends)
                accumulator[end_of_bonds] = none;
        };
#pragma omp for schedule(dynamic, 1)
        for (std::size_t block = 0; block < blocks; ++block)
            failure.guard(block, [&] { find_ends(block); });
    }
    failure.rethrow();
    first_.assign(blocks + 1, 0);
    for (std::size_t block = 0; block < blocks; ++block)
        first_[block + 1] = first_[block] + ends_of[block].size();
    for (const std::vector<std::uint32_t>& ends : ends_of)
        for (const std::uint32_t j : ends)
            ++first_contribution_[families.parent(j) + 1];
    std::partial_sum(first_contribution_.begin(), first_contribution_.end(), first_contribution_.begin());
    contributions_.resize(first_contribution_[n]);
    std::vector<std::size_t> next(first_contribution_.begin(), first_contribution_.end() - 1);
    for (std::size_t block = 0; block < blocks; ++block)
        for (std::size_t p = 0; p < ends_of[block].size(); ++p) {
            const std::uint32_t j = ends_of[block][p];
            contributions_[next[families.parent(j)]++] = {static_cast<std::uint32_t>(first_[block] + p),
                                                          families.isometry(j)};
        }
}

std::size_t BlockAccumulators::memory() const
{
    return (first_.capacity() + first_contribution_.capacity()) * sizeof(std::size_t) +
           of_neighbours_.capacity() * sizeof(std::uint16_t) + contributions_.capacity() * sizeof(Contribution);
}

} // namespace periporo
