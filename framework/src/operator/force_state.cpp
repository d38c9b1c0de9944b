// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// All force states by name. A new one is added to the table here.
#include "operator/force_state.hpp"

#include "operator/bond_projection.hpp"
#include "operator/point_correspondence.hpp"
#include "operator/sub_horizon.hpp"

#include <algorithm>
#include <iterator>

namespace periporo {
namespace {

struct NamedForceState {
    std::string name;
    std::unique_ptr<ForceState> (*make)(Influence influence);
};

template <SubHorizonForceState::Kind kind>
std::unique_ptr<ForceState> make_sub_horizon(Influence influence)
{
    return std::make_unique<SubHorizonForceState>(influence, kind);
}

template <class One>
std::unique_ptr<ForceState> make(Influence influence)
{
    return std::make_unique<One>(influence);
}

const std::vector<NamedForceState>& force_states()
{
    using Kind = SubHorizonForceState::Kind;
    static const std::vector<NamedForceState> all{
        {"energy_conjugate", make_sub_horizon<Kind::energy_conjugate>},
        {"energy_conjugate_mean", make_sub_horizon<Kind::energy_conjugate_mean>},
        {"volume_weighted", make_sub_horizon<Kind::volume_weighted>},
        {"bond_projection", make<BondProjectionForceState>},
        {"unstabilized", make<PointCorrespondenceForceState>},
    };
    return all;
}

} // namespace

const std::vector<std::string>& force_state_names()
{
    static const std::vector<std::string> names = [] {
        std::vector<std::string> all;
        std::ranges::transform(force_states(), std::back_inserter(all), &NamedForceState::name);
        return all;
    }();
    return names;
}

std::unique_ptr<ForceState> make_force_state(const std::string& name, Influence influence)
{
    const auto found = std::ranges::find(force_states(), name, &NamedForceState::name);
    if (found == force_states().end())
        throw std::invalid_argument("no force state is called '" + name + "'");
    return found->make(influence);
}

} // namespace periporo
