// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
#include "neighbourhood/families.hpp"

#include "neighbourhood/cell_list.hpp"
#include "periporo/first_exception.hpp"
#include "periporo/pack.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <numeric>
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

Families Families::find(const Points& points, IsometryTable& isometries, const FamilyRule& rule)
{
    Families families;
    families.images_ = find_images(points.position, isometries, rule.horizon);
    families.find_neighbours(points, isometries, rule);
    families.drop_one_sided(isometries);
    return families;
}

std::vector<Vector3> Families::positions_with_images(const Points& points, const IsometryTable& isometries) const
{
    std::vector<Vector3> positions(points.position);
    positions.reserve(points.size() + images_.size());
    for (const Image& image : images_)
        positions.push_back(isometries[image.isometry].point(points.position[image.parent]));
    return positions;
}

void Families::find_neighbours(const Points& points, const IsometryTable& isometries, const FamilyRule& rule)
{
    const std::size_t n = points.size();
    const std::vector<Vector3> positions = positions_with_images(points, isometries);
    const CellList cells(positions, rule.horizon);
    Links links(points, images_, isometries, rule);
    count_.assign(n, 0);
    const double reach_squared = rule.horizon * rule.horizon;
    const auto parent_of = [&](std::uint32_t c) { return c < n ? c : images_[c - n].parent; };
    const auto isometry_of = [&](std::uint32_t c) { return c < n ? 0 : images_[c - n].isometry; };
    const auto distance_squared = [&](std::uint32_t i, std::uint32_t c) {
        return mutual_distance_squared(points.position, i, parent_of(c), isometry_of(c), positions[c], isometries);
    };
    // Neighbours of a block of points go to buffers of the block; the buffers are joined in order.
    const std::size_t blocks = (n + block_size - 1) / block_size;
    Found near(blocks), linked(blocks), apart(blocks);
    std::vector<std::uint32_t> near_count(n), link_count(n), apart_count(n);
    const auto find_near = [&](std::size_t block) {
        for (std::uint32_t i = static_cast<std::uint32_t>(block * block_size);
             i < std::min(n, (block + 1) * block_size); ++i) {
            const std::size_t begin = near[block].size(), begin_links = linked[block].size();
            cells.visit_near(positions[i], [&](std::uint32_t c) {
                if (c != i && points.body[parent_of(c)] == points.body[i] && distance_squared(i, c) <= reach_squared)
                    near[block].push_back(c);
            });
            std::sort(near[block].begin() + static_cast<std::ptrdiff_t>(begin), near[block].end()); // by key, too
            for (std::size_t at = begin; at < near[block].size(); ++at)
                if (const std::uint32_t c = near[block][at]; links.linked(i, c, distance_squared(i, c)))
                    linked[block].push_back(c);
            near_count[i] = static_cast<std::uint32_t>(near[block].size() - begin);
            link_count[i] = static_cast<std::uint32_t>(linked[block].size() - begin_links);
        }
    };
    FirstException failure;
#pragma omp parallel for schedule(dynamic, 1)
    for (std::size_t block = 0; block < blocks; ++block)
        failure.guard(block, [&] { find_near(block); });
    failure.rethrow();
    links.store(linked, link_count);
#pragma omp parallel
    {
        ChainSearch chains;
        std::vector<std::uint32_t> family;
#pragma omp for schedule(dynamic, 1)
        for (std::size_t block = 0; block < blocks; ++block)
            failure.guard(block, [&] {
                family.clear();
                const std::uint32_t* next = near[block].data();
                for (std::uint32_t i = static_cast<std::uint32_t>(block * block_size);
                     i < std::min(n, (block + 1) * block_size); ++i) {
                    const std::size_t before = family.size(), apart_before = apart[block].size();
                    chains.find(links, positions, rule.horizon, i, {next, near_count[i]}, family, apart[block]);
                    next += near_count[i];
                    count_[i] = static_cast<std::uint32_t>(family.size() - before);
                    apart_count[i] = static_cast<std::uint32_t>(apart[block].size() - apart_before);
                }
                near[block].assign(family.begin(), family.end());
            });
    }
    failure.rethrow();
    check_sizes(points);
    lay_out(near);
    lay_out_apart(apart, apart_count);
}

void Families::check_sizes(const Points& points) const
{
    const auto crowded = std::ranges::find_if(count_, [](std::uint32_t c) { return c > largest_family; });
    if (crowded == count_.end())
        return;
    const auto i = static_cast<std::size_t>(crowded - count_.begin());
    const Vector3& x = points.position[i];
    throw std::runtime_error(
        fmt::format("point {} at ({:.5g}, {:.5g}, {:.5g}) m has {} points within its horizon, more "
                    "than {}: points lie on top of each other, or the horizon is too large",
                    points.id[i], x.x(), x.y(), x.z(), *crowded, largest_family));
}

void Families::lay_out(const Found& found)
{
    const std::size_t n = count_.size();
    first_pack_.assign(n + 1, 0);
    for (std::size_t i = 0; i < n; ++i)
        first_pack_[i + 1] = first_pack_[i] + (count_[i] + pack_width - 1) / pack_width;
    neighbours_.assign((first_pack_[n] + 1) * pack_width, 0);
    lower_.assign(n, 0);
#pragma omp parallel for schedule(static)
    for (std::size_t block = 0; block < found.size(); ++block) {
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

void Families::lay_out_apart(const Found& found, std::span<const std::uint32_t> counts)
{
    first_apart_.assign(counts.size() + 1, 0);
    for (std::size_t i = 0; i < counts.size(); ++i)
        first_apart_[i + 1] = first_apart_[i] + counts[i];
    apart_.clear();
    apart_.reserve(first_apart_.back());
    for (const std::vector<std::uint32_t>& block : found)
        apart_.insert(apart_.end(), block.begin(), block.end());
}

void Families::drop_one_sided(const IsometryTable& isometries)
{
    const std::size_t n = points();
    const auto one_sided = [&](std::size_t i, std::uint32_t c) {
        return c >= n && !holds(parent(c), opposite_key(static_cast<std::uint32_t>(i), c, isometries));
    };
    std::vector<std::uint8_t> concerned(n, 0);
    bool some = false;
#pragma omp parallel for schedule(static) reduction(|| : some)
    for (std::size_t i = 0; i < n; ++i) {
        const FamilyView family = (*this)[i];
        if (std::any_of(family.neighbours, family.neighbours + family.count,
                        [&](std::uint32_t c) { return one_sided(i, c); }))
            concerned[i] = 1, some = true;
    }
    if (!some)
        return;
    Found kept((n + block_size - 1) / block_size), apart(kept.size());
    std::vector<std::uint32_t> counts(n), apart_counts(n);
    for (std::size_t i = 0; i < n; ++i) {
        const FamilyView family = (*this)[i];
        std::vector<std::uint32_t>& own = kept[i / block_size];
        std::vector<std::uint32_t>& others = apart[i / block_size];
        const std::size_t before = own.size(), apart_before = others.size();
        others.insert(others.end(), this->apart(i).begin(), this->apart(i).end());
        for (std::size_t b = 0; b < family.count; ++b)
            (concerned[i] != 0 && one_sided(i, family.neighbours[b]) ? others : own).push_back(family.neighbours[b]);
        counts[i] = static_cast<std::uint32_t>(own.size() - before);
        apart_counts[i] = static_cast<std::uint32_t>(others.size() - apart_before);
    }
    count_ = std::move(counts);
    lay_out(kept);
    lay_out_apart(apart, apart_counts);
}

Families::Kept Families::kept() const
{
    Kept kept;
    kept.family_counts = count_;
    kept.apart_neighbours = apart_;
    for (std::size_t i = 0; i < points(); ++i) {
        const FamilyView family = (*this)[i];
        kept.family_neighbours.insert(kept.family_neighbours.end(), family.neighbours,
                                      family.neighbours + family.count);
        kept.apart_counts.push_back(static_cast<std::uint32_t>(apart(i).size()));
    }
    return kept;
}

Families Families::restore(const Points& points, IsometryTable& isometries, double horizon, const Kept& kept)
{
    Families families;
    families.images_ = find_images(points.position, isometries, horizon);
    const std::size_t n = points.size();
    const std::size_t records = n + families.images_.size();
    const auto fit = [&](const std::vector<std::uint32_t>& counts, const std::vector<std::uint32_t>& neighbours,
                         std::uint32_t most) {
        return counts.size() == n && std::ranges::all_of(counts, [&](std::uint32_t c) { return c <= most; }) &&
               std::accumulate(counts.begin(), counts.end(), std::size_t{0}) == neighbours.size() &&
               std::ranges::all_of(neighbours, [&](std::uint32_t c) { return c < records; });
    };
    if (!fit(kept.family_counts, kept.family_neighbours, largest_family) ||
        !fit(kept.apart_counts, kept.apart_neighbours, static_cast<std::uint32_t>(records)))
        throw std::runtime_error("the families that were kept do not fit these points");
    const auto by_block = [&](const std::vector<std::uint32_t>& counts, const std::vector<std::uint32_t>& neighbours) {
        Found found((n + block_size - 1) / block_size);
        auto next = neighbours.begin();
        for (std::size_t i = 0; i < n; ++i) {
            found[i / block_size].insert(found[i / block_size].end(), next, next + counts[i]);
            next += counts[i];
        }
        return found;
    };
    families.count_ = kept.family_counts;
    families.lay_out(by_block(kept.family_counts, kept.family_neighbours));
    families.lay_out_apart(by_block(kept.apart_counts, kept.apart_neighbours), kept.apart_counts);
    if (!families.are_sound(points, isometries, horizon))
        throw std::runtime_error("the families that were kept do not fit these points");
    return families;
}

bool Families::are_sound(const Points& points, const IsometryTable& isometries, double horizon) const
{
    const std::vector<Vector3> positions = positions_with_images(points, isometries);
    const double reach_squared = horizon * horizon * (1.0 + 1e-9); // round-off of another order of operations
    bool sound = true;
#pragma omp parallel for schedule(static) reduction(&& : sound)
    for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(this->points()); ++i) {
        const FamilyView family = (*this)[i];
        for (std::size_t b = 0; b < family.count; ++b) {
            const std::uint32_t c = family.neighbours[b];
            sound = sound && c != i && (b == 0 || key(family.neighbours[b - 1]) < key(c)) &&
                    points.body[parent(c)] == points.body[i] &&
                    (positions[c] - positions[i]).squaredNorm() <= reach_squared &&
                    holds(parent(c), opposite_key(i, c, isometries));
        }
    }
    return sound;
}

std::optional<std::size_t> Families::find_bond(std::uint32_t point, std::uint64_t wanted) const
{
    const FamilyView family = (*this)[point];
    const std::uint32_t* end = family.neighbours + family.count;
    const std::uint32_t* at = std::lower_bound(family.neighbours, end, wanted,
                                               [this](std::uint32_t c, std::uint64_t k) { return key(c) < k; });
    if (at == end || key(*at) != wanted)
        return std::nullopt;
    return static_cast<std::size_t>(at - family.neighbours);
}

std::size_t Families::opposite(std::uint32_t point, std::uint32_t neighbour, const IsometryTable& isometries) const
{
    const auto bond = find_bond(parent(neighbour), opposite_key(point, neighbour, isometries));
    if (!bond)
        throw std::logic_error("families are not mutual: a bond has no bond in the opposite direction");
    return *bond;
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
           (neighbours_.capacity() + apart_.capacity()) * sizeof(std::uint32_t) +
           first_apart_.capacity() * sizeof(std::size_t);
}

} // namespace periporo
