// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
#include "operator/force_state.hpp"

#include "operator/bond_projection.hpp"
#include "operator/point_correspondence.hpp"
#include "operator/sub_horizon.hpp"

namespace periporo {

const std::vector<std::string>& force_state_names()
{
    static const std::vector<std::string> names{"energy_conjugate", "energy_conjugate_mean", "volume_weighted",
                                                "bond_projection", "unstabilized"};
    return names;
}

std::unique_ptr<ForceState> make_force_state(const std::string& name, Influence influence)
{
    using Kind = SubHorizonForceState::Kind;
    if (name == "energy_conjugate")
        return std::make_unique<SubHorizonForceState>(influence, Kind::energy_conjugate);
    if (name == "energy_conjugate_mean")
        return std::make_unique<SubHorizonForceState>(influence, Kind::energy_conjugate_mean);
    if (name == "volume_weighted")
        return std::make_unique<SubHorizonForceState>(influence, Kind::volume_weighted);
    if (name == "bond_projection")
        return std::make_unique<BondProjectionForceState>(influence);
    if (name == "unstabilized")
        return std::make_unique<PointCorrespondenceForceState>(influence);
    throw std::invalid_argument("no force state is called '" + name + "'");
}

} // namespace periporo
