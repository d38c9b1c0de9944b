// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Copies the values of points to the ends of bonds, and to images under their isometries.
#include "neighbourhood/bond_ends.hpp"

namespace periporo {

void BondEnds::gather(const Points& points, const std::vector<Vector3>& velocity, const Neighbourhood& neighbourhood)
{
    const std::size_t n = points.size();
    const std::vector<Image>& images = neighbourhood.families.images();
    ends_.resize(n + images.size());
    const auto store = [&](std::size_t end, const Vector3& x, const Vector3& v, std::size_t point) {
        ends_[end] = {{x.x(), x.y(), x.z()}, points.volume[point], {v.x(), v.y(), v.z()}, points.mass[point]};
    };
    bool some_water = false;
#pragma omp parallel for schedule(static) reduction(|| : some_water)
    for (std::size_t i = 0; i < n; ++i) {
        store(i, points.position[i], velocity[i], i);
        some_water = some_water || points.pore_pressure[i] != 0.0 || points.saturation[i] != 0.0;
    }
#pragma omp parallel for schedule(static)
    for (std::size_t m = 0; m < images.size(); ++m) {
        const Isometry& isometry = neighbourhood.isometries[images[m].isometry];
        const std::uint32_t p = images[m].parent;
        store(n + m, isometry.point(points.position[p]), isometry.direction(velocity[p]), p);
    }
    wet_ = some_water;
    if (wet_)
        gather_water(points, neighbourhood);
}

void BondEnds::gather_water(const Points& points, const Neighbourhood& neighbourhood)
{
    water_.resize(ends_.size());
#pragma omp parallel for schedule(static)
    for (std::size_t i = 0; i < points.size(); ++i)
        water_[i] = {points.suction(i), points.saturation[i]};
    neighbourhood.fill_images(water_);
}

std::size_t BondEnds::memory() const
{
    return ends_.capacity() * sizeof(BondEnd) + water_.capacity() * sizeof(EndWater);
}

} // namespace periporo
