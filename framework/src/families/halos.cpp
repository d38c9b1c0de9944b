// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
#include "families/halos.hpp"

#include "periporo/first_exception.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

namespace periporo {

void Halos::find(const Families& families)
{
    const std::size_t n = families.points();
    const std::size_t blocks = (n + block_size - 1) / block_size;
    place_of_.assign(families.packs() * pack_width, 0);
    first_arrival_.assign(n + 1, 0);
    std::vector<std::vector<std::uint32_t>> at_place(blocks); // points and images
    FirstException failure;
#pragma omp parallel
    {
        constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
        std::vector<std::uint32_t> place; // of a record in the block
        failure.guard_set_up([&] { place.assign(n + families.images().size(), none); });
        const auto find_places = [&](std::size_t block) {
            std::vector<std::uint32_t>& places = at_place[block];
            const auto first = static_cast<std::uint32_t>(first_point(block));
            const auto end = static_cast<std::uint32_t>(end_point(block));
            for (std::uint32_t i = first; i < end; ++i) {
                place[i] = i - first;
                places.push_back(i);
            }
            for (std::uint32_t i = first; i < end; ++i) {
                const FamilyView family = families[i];
                std::uint16_t* place_of = place_of_.data() + family.first_pack * pack_width;
                for (std::size_t b = 0; b < family.count; ++b) {
                    std::uint32_t& at = place[family.neighbours[b]];
                    if (at == none) {
                        at = static_cast<std::uint32_t>(places.size());
                        places.push_back(family.neighbours[b]);
                    }
                    place_of[b] = static_cast<std::uint16_t>(at);
                }
            }
            for (const std::uint32_t j : places)
                place[j] = none;
        };
#pragma omp for schedule(dynamic, 1)
        for (std::size_t block = 0; block < blocks; ++block)
            failure.guard(block, [&] { find_places(block); });
    }
    failure.rethrow();
    first_place_.assign(blocks + 1, 0);
    for (std::size_t block = 0; block < blocks; ++block)
        first_place_[block + 1] = first_place_[block] + at_place[block].size();
    for (const std::vector<std::uint32_t>& places : at_place)
        for (const std::uint32_t j : places)
            ++first_arrival_[families.parent(j) + 1];
    std::partial_sum(first_arrival_.begin(), first_arrival_.end(), first_arrival_.begin());
    arrivals_.resize(first_arrival_[n]);
    std::vector<std::size_t> next(first_arrival_.begin(), first_arrival_.end() - 1);
    for (std::size_t block = 0; block < blocks; ++block)
        for (std::size_t p = 0; p < at_place[block].size(); ++p) {
            const std::uint32_t j = at_place[block][p];
            arrivals_[next[families.parent(j)]++] = {static_cast<std::uint32_t>(first_place_[block] + p),
                                                     families.isometry(j)};
        }
}

std::size_t Halos::memory() const
{
    return (first_place_.capacity() + first_arrival_.capacity()) * sizeof(std::size_t) +
           place_of_.capacity() * sizeof(std::uint16_t) + arrivals_.capacity() * sizeof(Arrival);
}

} // namespace periporo
