// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
#include "scheduler/output_checks.hpp"

#include "case/diagnostics.hpp"
#include "case/refusal.hpp"
#include "diagnostics/snapshot_fields.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace periporo {
namespace {

void check_list(const CaseDescription& description, const std::string& key, const std::vector<std::string>& wanted,
                const std::vector<std::string>& known, Refusals& refusals)
{
    for (auto name = wanted.begin(); name != wanted.end(); ++name)
        refusals.attempt(key, [&] {
            if (std::ranges::find(known, *name) == known.end())
                throw refusal(description, key, fmt::format("there is no field '{}'", *name),
                              naming_hint(*name, known, "fields of this case"));
            if (std::find(wanted.begin(), name, *name) != name)
                throw refusal(description, key, fmt::format("the field '{}' is named twice", *name));
        });
}

} // namespace

void check_fields(const CaseDescription& description, const PluginRegistry& registry, const Model& model,
                  const ForceState& force_state)
{
    std::vector<std::string> known;
    Refusals refusals(description);
    for (std::size_t o = 0; o < description.outputs.size(); ++o) {
        const PluginChoice& writer = description.outputs[o].writer;
        for (const Parameter& record : registry.require(PluginKind::output, writer.name).parameters) {
            const auto given = writer.parameters.values().find(record.name);
            if (record.naming != Naming::field || given == writer.parameters.values().end())
                continue;
            if (known.empty()) {
                SnapshotFields fields;
                for (const FieldView& field : fields.collect(model, force_state))
                    known.emplace_back(field.name);
            }
            check_list(description, fmt::format("output.{}.{}", o, record.name),
                       std::get<std::vector<std::string>>(given->second), known, refusals);
        }
    }
    refusals.raise();
}

} // namespace periporo
