// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Calls the material for all bonds of a point.
#include "operator/bond_update.hpp"

namespace periporo {

void StressWorkspace::reserve(std::size_t packs)
{
    if (lanes.size() >= packs)
        return;
    const std::size_t row = packs * pack_width;
    strain.resize(6 * row);
    first_work.resize(row);
    for (AlignedVector<double>* one : {&suction, &saturation})
        one->resize(row); // zero, as dry bonds have them
    lanes.resize(packs);
}

void gather_water(const BondEnds& ends, std::size_t point, const std::uint32_t* neighbours, std::size_t packs,
                  StressWorkspace& workspace)
{
    for (std::size_t b = 0; b < packs * pack_width; ++b) {
        const EndWater water = ends.water_between(point, neighbours[b]);
        workspace.suction[b] = water.suction;
        workspace.saturation[b] = water.saturation;
    }
}

BondStress::BondStress(const OperatorInput& input, std::size_t point, const std::uint32_t* neighbours,
                       std::size_t packs, double* state, const Evaluation& evaluation, StressWorkspace& workspace)
    : evaluation_(evaluation), workspace_(workspace), material_(*input.state.body_of(point).material), packs_(packs),
      rows_(input.state.rows(point)), state_(state), bulk_modulus_(material_.bulk_modulus()),
      shear_modulus_(material_.shear_modulus()), wet_(input.ends.wet())
{
    workspace_.reserve(packs);
    if (wet_)
        gather_water(input.ends, point, neighbours, packs, workspace_);
}

MaterialStatus BondStress::update()
{
    if (evaluation_.stress != StressUpdate::advance)
        return {};
    return material_.update({packs_, state_, workspace_.strain.data(), workspace_.suction.data(),
                             workspace_.saturation.data(), workspace_.lanes.data(), evaluation_.time_step,
                             evaluation_.response});
}

} // namespace periporo
