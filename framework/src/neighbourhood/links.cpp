// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Finds links of points and images, and what chains of them reach.
#include "neighbourhood/links.hpp"

#include "neighbourhood/families.hpp"

#include <algorithm>

namespace periporo {
namespace {

constexpr std::uint8_t near_by = 1;
constexpr std::uint8_t one_link = 2;
constexpr std::uint8_t two_links = 3;

} // namespace

Links::Links(const Points& points, std::span<const Image> images, const IsometryTable& isometries,
             const FamilyRule& rule)
    : points_(points), images_(images), isometries_(isometries), rule_(rule), had_images_(isometries.size(), 0)
{
    had_images_[0] = 1;
    if (rule.before != nullptr)
        for (const Image& image : rule.before->images())
            had_images_[image.isometry] = 1;
}

bool Links::linked(std::uint32_t point, std::uint32_t neighbour, double distance_squared) const
{
    if (distance_squared > rule_.link * rule_.link)
        return false;
    if (rule_.before == nullptr || had_images_[isometry(neighbour)] == 0)
        return true;
    if (!rule_.joining.empty()) {
        const double joining = rule_.joining[points_.body[point]];
        if (distance_squared < joining * joining)
            return true;
    }
    const std::uint64_t key = neighbour_key(isometry(neighbour), parent(neighbour));
    return rule_.before->holds(point, key) || std::ranges::binary_search(rule_.closed, ClosedPair{point, key});
}

void Links::store(std::span<const std::vector<std::uint32_t>> of_points, std::span<const std::uint32_t> counts)
{
    const std::size_t n = points_.size();
    const std::size_t records = n + images_.size();
    count_.assign(counts.begin(), counts.end());
    count_.resize(records);
    first_.resize(records);
    std::size_t end = 0;
    for (std::size_t record = 0; record < records; ++record) {
        first_[record] = end;
        end += record < n ? counts[record] : counts[images_[record - n].parent]; // an image has no more than its parent
    }
    linked_.resize(end);
    std::size_t at = 0;
    for (const std::vector<std::uint32_t>& block : of_points) {
        std::ranges::copy(block, linked_.begin() + static_cast<std::ptrdiff_t>(at));
        at += block.size();
    }
    find_products();
#pragma omp parallel for schedule(static)
    for (std::size_t m = 0; m < images_.size(); ++m)
        find_links_of_image(m);
}

void Links::find_products()
{
    std::vector<std::uint32_t> numbers{0};
    first_image_ = {0, 0}; // the identity has no images
    for (std::size_t m = 0; m < images_.size(); ++m)
        if (images_[m].isometry != numbers.back()) {
            numbers.push_back(images_[m].isometry);
            first_image_.back() = m;
            first_image_.push_back(m);
        }
    first_image_.back() = images_.size();
    in_use_ = numbers.size();
    place_.assign(isometries_.size(), none);
    for (std::uint32_t p = 0; p < in_use_; ++p)
        place_[numbers[p]] = p;
    products_.assign(in_use_ * in_use_, none);
    for (std::size_t g = 0; g < in_use_; ++g)
        for (std::size_t h = 0; h < in_use_; ++h) {
            const auto product = isometries_.find(isometries_[numbers[g]].after(isometries_[numbers[h]]));
            if (product)
                products_[g * in_use_ + h] = place_[*product];
        }
}

/// Links of an image are those of its parent, seen under its isometry.
void Links::find_links_of_image(std::size_t image)
{
    const std::size_t record = points_.size() + image;
    const std::size_t own = place_[images_[image].isometry];
    std::uint32_t* links = linked_.data() + first_[record];
    std::uint32_t count = 0;
    for (const std::uint32_t c : (*this)[images_[image].parent]) {
        const std::uint32_t product = products_[own * in_use_ + place_[isometry(c)]];
        if (product == none)
            continue;
        if (product == 0) {
            links[count++] = parent(c);
            continue;
        }
        const auto begin = images_.begin() + static_cast<std::ptrdiff_t>(first_image_[product]);
        const auto end = images_.begin() + static_cast<std::ptrdiff_t>(first_image_[product + 1]);
        const auto found = std::lower_bound(begin, end, parent(c),
                                            [](const Image& i, std::uint32_t wanted) { return i.parent < wanted; });
        if (found != end && found->parent == parent(c)) // others lie beyond all horizons
            links[count++] =
                static_cast<std::uint32_t>(points_.size() + static_cast<std::size_t>(found - images_.begin()));
    }
    count_[record] = count;
}

void ChainSearch::find(const Links& links, std::span<const Vector3> positions, double horizon, std::uint32_t point,
                       std::span<const std::uint32_t> near, std::vector<std::uint32_t>& connected,
                       std::vector<std::uint32_t>& apart)
{
    links_to_.resize(positions.size(), 0);
    for (const std::uint32_t c : near)
        links_to_[c] = near_by;
    for (const std::uint32_t a : links[point])
        links_to_[a] = one_link;
    for (const std::uint32_t a : links[point])
        for (const std::uint32_t b : links[a])
            if (links_to_[b] == near_by)
                links_to_[b] = two_links;
    for (const std::uint32_t c : near) {
        const bool reached = links_to_[c] != near_by || reached_by_three(links, positions, horizon * horizon, c);
        (reached ? connected : apart).push_back(c);
    }
    for (const std::uint32_t c : near)
        links_to_[c] = 0;
}

bool ChainSearch::reached_by_three(const Links& links, std::span<const Vector3> positions, double horizon_squared,
                                   std::uint32_t neighbour) const
{
    return std::ranges::any_of(links[neighbour], [&](std::uint32_t b) {
        return links_to_[b] == two_links && std::ranges::any_of(links[b], [&](std::uint32_t a) {
                   return links_to_[a] == one_link &&
                          (positions[a] - positions[neighbour]).squaredNorm() <= horizon_squared;
               });
    });
}

} // namespace periporo
