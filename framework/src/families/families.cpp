// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
#include "families/families.hpp"

#include "families/cell_list.hpp"
#include "periporo/pack.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <stdexcept>

namespace periporo {
namespace {

/// |x_i - g x_p|^2, evaluated so that (i, g p) and (p, g^-1 i) give the same bits: membership of a family is mutual.
double mutual_distance_squared(const std::vector<Vector3>& x, std::uint32_t i, std::uint32_t p, std::uint32_t isometry,
                               const Vector3& image, const IsometryTable& isometries)
{
    if (isometry == 0)
        return (image - x[i]).squaredNorm();
    const std::uint32_t opposite = isometries.inverse(isometry);
    const bool canonical = i != p ? i < p : isometry <= opposite;
    return canonical ? (image - x[i]).squaredNorm() : (isometries[opposite].point(x[i]) - x[p]).squaredNorm();
}

} // namespace

Families Families::find(const Points& points, IsometryTable& isometries, double horizon)
{
    Families families;
    families.images_ = find_images(points.position, isometries, horizon);
    families.find_neighbours(points, isometries, horizon);
    return families;
}

void Families::find_neighbours(const Points& points, const IsometryTable& isometries, double horizon)
{
    const std::size_t n = points.size();
    std::vector<Vector3> positions(points.position);
    positions.reserve(n + images_.size());
    for (const Image& image : images_)
        positions.push_back(isometries[image.isometry].point(points.position[image.parent]));
    const CellList cells(positions, horizon);

    count_.assign(n, 0);
    const double reach_squared = horizon * horizon;
    const auto parent_of = [&](std::uint32_t c) { return c < n ? c : images_[c - n].parent; };
    const auto isometry_of = [&](std::uint32_t c) { return c < n ? 0 : images_[c - n].isometry; };
    const auto collect = [&](std::uint32_t i, std::vector<std::uint32_t>& family) {
        family.clear();
        cells.visit_near(positions[i], [&](std::uint32_t c) {
            const std::uint32_t p = parent_of(c);
            if (c == i || points.body[p] != points.body[i])
                return;
            if (mutual_distance_squared(points.position, i, p, isometry_of(c), positions[c], isometries) <=
                reach_squared)
                family.push_back(c);
        });
    };
    // Families of a block of points go to a buffer of the block; the buffers are joined in order.
    const std::size_t blocks = (n + block_size - 1) / block_size;
    std::vector<std::vector<std::uint32_t>> found(blocks);
#pragma omp parallel
    {
        std::vector<std::uint32_t> family;
#pragma omp for schedule(dynamic, 1)
        for (std::size_t block = 0; block < blocks; ++block)
            for (std::size_t i = block * block_size; i < std::min(n, (block + 1) * block_size); ++i) {
                collect(static_cast<std::uint32_t>(i), family);
                std::sort(family.begin(), family.end()); // by key, since points and images are
                count_[i] = static_cast<std::uint32_t>(family.size());
                found[block].insert(found[block].end(), family.begin(), family.end());
            }
    }
    if (const auto crowded =
            std::find_if(count_.begin(), count_.end(), [](std::uint32_t c) { return c > largest_family; });
        crowded != count_.end())
        throw std::runtime_error(
            fmt::format("point {} has {} points within its horizon, more than {}: points lie on top of "
                        "each other",
                        points.id[static_cast<std::size_t>(crowded - count_.begin())], *crowded, largest_family));
    first_pack_.assign(n + 1, 0);
    for (std::size_t i = 0; i < n; ++i)
        first_pack_[i + 1] = first_pack_[i] + (count_[i] + pack_width - 1) / pack_width;
    neighbours_.assign((first_pack_[n] + 1) * pack_width, 0);
    lower_.assign(n, 0);
#pragma omp parallel for schedule(static)
    for (std::size_t block = 0; block < blocks; ++block) {
        const std::uint32_t* next = found[block].data();
        for (std::size_t i = block * block_size; i < std::min(n, (block + 1) * block_size); ++i) {
            std::uint32_t* family = neighbours_.data() + first_pack_[i] * pack_width;
            std::uint32_t* end = neighbours_.data() + first_pack_[i + 1] * pack_width;
            std::fill(std::copy(next, next + count_[i], family), end, static_cast<std::uint32_t>(i));
            lower_[i] = static_cast<std::uint16_t>(std::lower_bound(next, next + count_[i], i) - next);
            next += count_[i];
        }
    }
}

std::size_t Families::opposite(std::uint32_t point, std::uint32_t neighbour, const IsometryTable& isometries) const
{
    const FamilyView family = (*this)[parent(neighbour)];
    const std::uint64_t wanted = (static_cast<std::uint64_t>(isometries.inverse(isometry(neighbour))) << 32) | point;
    const std::uint32_t* end = family.neighbours + family.count;
    const std::uint32_t* at = std::lower_bound(family.neighbours, end, wanted,
                                               [this](std::uint32_t c, std::uint64_t k) { return key(c) < k; });
    if (at == end || key(*at) != wanted)
        throw std::logic_error("families are not mutual: a bond has no bond in the opposite direction");
    return static_cast<std::size_t>(at - family.neighbours);
}

std::size_t Families::bonds() const
{
    std::size_t sum = 0;
    for (const std::uint32_t count : count_)
        sum += count;
    return sum;
}

std::size_t Families::memory() const
{
    return images_.capacity() * sizeof(Image) + count_.capacity() * sizeof(std::uint32_t) +
           lower_.capacity() * sizeof(std::uint16_t) + first_pack_.capacity() * sizeof(std::size_t) +
           neighbours_.capacity() * sizeof(std::uint32_t);
}

} // namespace periporo
