// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
#include "diagnostics/summary.hpp"

#include "periporo/file.hpp"

#include <nlohmann/json.hpp>

namespace periporo {

nlohmann::json summary_of(const CaseDescription& description, const Model& model, const Dynamics& dynamics)
{
    nlohmann::json symmetry = nlohmann::json::array();
    for (const BoundaryDescription& boundary : description.boundaries)
        if (boundary.kind == ImageKind::symmetry)
            symmetry.push_back(std::string(1, "xyz"[boundary.plane.axis]));
    nlohmann::json the_case{{"title", description.title},
                            {"file", description.file.filename().string()},
                            {"spacing", model.state.spacing},
                            {"horizon", model.state.horizon},
                            {"force_state", description.operators.force_state},
                            {"influence", description.operators.influence},
                            {"symmetry", symmetry}};
    if (description.comparison)
        the_case["comparison"] = {{"law", description.comparison->law},
                                  {"radius", description.comparison->radius},
                                  {"height", description.comparison->height}};
    nlohmann::json phases;
    for (std::size_t p = 0; p < phase_count; ++p)
        phases[phase_names[p]] = dynamics.times()[static_cast<Phase>(p)];
    const EnergyLedger& ledger = dynamics.ledger();
    return {{"format", "periporo summary"},
            {"case", the_case},
            {"points", model.size()},
            {"bonds", model.neighbourhood.families.bonds()},
            {"refreshes", dynamics.refreshes()},
            {"bytes_per_point", static_cast<double>(model.memory()) / static_cast<double>(model.size())},
            {"phase_seconds", phases},
            {"energy",
             {{"unit", "J"},
              {"kinetic", ledger.kinetic},
              {"gravity", ledger.gravity},
              {"stress_work", ledger.stress_work},
              {"contact", ledger.contact},
              {"friction", ledger.friction},
              {"collision", ledger.collision},
              {"boundary", ledger.boundary},
              {"turned_over", ledger.turned_over},
              {"error", ledger.error()}}}};
}

void write_json(const nlohmann::json& content, const std::filesystem::path& file)
{
    // Names of files need not be UTF-8, and a summary does not fail for that.
    write_whole(file, content.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + '\n');
}

} // namespace periporo
