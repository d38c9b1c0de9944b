// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
#include "diagnostics/dispersion_table.hpp"

#include "assembly/build_model.hpp"
#include "diagnostics/dispersion.hpp"
#include "water/mixture.hpp"

#include <fmt/format.h>

namespace periporo {

std::string dispersion_table(const CaseDescription& description, const PluginRegistry& registry, int cells)
{
    const BodyDescription& body = description.bodies.front();
    const double spacing = description.discretization.spacing;
    const LatticeMedium medium{make_material(description, body, registry),
                               mixture_density(material_of(description, body), 0.0), spacing,
                               description.discretization.horizon()};
    std::string table = "force_state,influence,direction,wave,wave_number_times_spacing,relative_phase_speed\n";
    for (const std::string& state : force_state_names())
        for (const std::string& influence : influence_names()) {
            const auto force = make_force_state(state, Influence::by_name(influence, medium.horizon));
            for (const PhaseSpeed& point : dispersion(medium, *force, cells))
                table +=
                    fmt::format("{},{},{},{},{:.6f},{:.6f}\n", state, influence,
                                std::array{"100", "110", "111"}[static_cast<std::size_t>(point.direction)],
                                point.type == WaveType::pressure ? 'P' : 'S', point.wave_number, point.relative_speed);
        }
    return table;
}

} // namespace periporo
