// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Tables, texts and files of a path.
#include "drive/path_results.hpp"

#include "case/resolved.hpp"
#include "drive/stage_plan.hpp"
#include "drive/yield_surface.hpp"
#include "periporo/file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace periporo {
namespace {

namespace fs = std::filesystem;

struct Column {
    std::string name;
    std::string unit; ///< empty for a plain count
    double value = 0.0;
};

std::vector<Column> columns_of(const PathDescription& path, const PathRow& row)
{
    const MaterialPoint& point = row.point;
    std::vector<Column> columns = {{"step", "", static_cast<double>(row.step)},
                                   {"stage", "", static_cast<double>(row.stage)},
                                   {"time", "s", row.time}};
    for (std::size_t c = 0; c < 6; ++c)
        columns.push_back(
            {fmt::format("stress_{}", symmetric_component_names[c]), "Pa", components(point.stress())[c]});
    for (std::size_t c = 0; c < 6; ++c)
        columns.push_back({fmt::format("strain_{}", symmetric_component_names[c]), "-", components(point.strain())[c]});
    columns.push_back({"p", "Pa", mean_pressure(point.stress())});
    columns.push_back({"q", "Pa", deviator_stress(point.stress())});
    columns.push_back({"volumetric_compression", "-", 0.0 - trace(point.strain())});
    columns.push_back({"equivalent_shear_strain", "-", equivalent_shear_strain(point.strain())});
    if (const std::optional<double> volume = specific_volume(path, point)) {
        columns.push_back({"specific_volume", "-", *volume});
        columns.push_back({"void_ratio", "-", *volume - 1.0});
    }
    columns.push_back({"suction", "Pa", point.suction()});
    columns.push_back({"saturation", "-", point.saturation()});
    const std::vector<StateVariable>& variables = point.material().state_variables();
    for (std::size_t s = 0; s < variables.size(); ++s)
        columns.push_back({variables[s].name, variables[s].unit, point.state(s)});
    return columns;
}

/// The yield surfaces at start and end, or nothing when the law has none.
std::string yield_surface_table(const PathRecord& record)
{
    double scale = 0.0;
    for (const PathRow& row : record.rows)
        scale = std::max({scale, std::abs(mean_pressure(row.point.stress())), deviator_stress(row.point.stress())});
    std::string rows;
    const auto append = [&](const char* moment, const MaterialPoint& point) {
        for (const TriaxialStress& stress : yield_surface(point, scale))
            rows += fmt::format("{},{},{}\n", moment, stress.p, stress.q);
    };
    append("initial", record.rows.front().point);
    append("final", record.rows.back().point);
    return rows.empty() ? rows : "moment,p [Pa],q [Pa]\n" + rows;
}

/// "xx = -1000.0, yy = ..." of the components for which a value is there.
std::string component_list(const std::array<std::optional<double>, 6>& components)
{
    std::vector<std::string> parts;
    for (std::size_t c = 0; c < 6; ++c)
        if (components[c])
            parts.push_back(fmt::format("{} = {}", symmetric_component_names[c], toml_text(*components[c])));
    return fmt::format("{}", fmt::join(parts, ", "));
}

std::array<std::optional<double>, 6> all_components(const SymmetricTensor<double>& tensor)
{
    std::array<std::optional<double>, 6> all;
    std::ranges::copy(components(tensor), all.begin());
    return all;
}

std::string state_list(const MaterialPoint& point, const char* separator)
{
    std::vector<std::string> parts;
    const std::vector<StateVariable>& variables = point.material().state_variables();
    for (std::size_t s = 0; s < variables.size(); ++s)
        parts.push_back(fmt::format("{} = {}", variables[s].name, toml_text(point.state(s))));
    return fmt::format("{}", fmt::join(parts, separator));
}

/// "stage 2 'shear' (triaxial_drained), step 151"
std::string place_of(const FailedStep& failure, const PathDescription& path)
{
    const PathStage& stage = path.stages.at(failure.stage - 1);
    return fmt::format("stage {}{} ({}), step {}", failure.stage,
                       stage.name.empty() ? "" : fmt::format(" '{}'", stage.name), stage.type, failure.step);
}

std::string material_text(const PathDescription& path, const MaterialPoint& point)
{
    std::string text = fmt::format("[material.{}]\nmodel = {}\n", path.material_name, toml_text(path.model.name));
    if (path.grain_density)
        text += fmt::format("grain_density = {}\n", toml_text(*path.grain_density));
    // a path may squeeze out more pores than there are, and no file may say so
    if (const std::optional<double> volume = specific_volume(path, point); volume && *volume >= 1.0)
        text += fmt::format("porosity = {}\n", toml_text(1.0 - 1.0 / *volume));
    for (const auto& [name, value] : path.model.parameters.values())
        text += fmt::format("{} = {}\n", name, toml_text(value));
    return text;
}

std::string stage_text(const FailedStep& failure, const PathStage& stage)
{
    const MixedStage& step = failure.increment;
    std::array<std::optional<double>, 6> strain;
    for (std::size_t c = 0; c < 6; ++c)
        if (!step.stress[c])
            strain[c] = step.strain[c];
    return fmt::format("[[stage]]\ntype = \"mixed\"\nmotion = \"{}\"\nsteps = 1\nhalvings = {}\nduration = {}\n"
                       "suction = {}\nsaturation = {}\nstress = {{ {} }}\nstrain = {{ {} }}\n",
                       step.simple_shear ? "simple_shear" : "irrotational", stage.halvings,
                       toml_text(failure.time_step), toml_text(step.suction.value()),
                       toml_text(step.saturation.value()), component_list(step.stress), component_list(strain));
}

} // namespace

std::string path_table(const PathDescription& path, const PathRecord& record)
{
    std::string text;
    for (const PathRow& row : record.rows) {
        const std::vector<Column> columns = columns_of(path, row);
        if (text.empty()) {
            for (const Column& column : columns)
                text += (text.empty() ? "" : ",") + column.name +
                        (column.unit.empty() ? "" : fmt::format(" [{}]", column.unit));
            text += '\n';
        }
        for (std::size_t c = 0; c < columns.size(); ++c)
            text += fmt::format("{}{}", c == 0 ? "" : ",", columns[c].value);
        text += '\n';
    }
    return text;
}

std::string failing_step_text(const PathDescription& path, const PathRecord& record)
{
    const FailedStep& failure = record.failure.value();
    const MaterialPoint& before = record.rows.back().point;
    std::string text =
        fmt::format("# The step of a path that failed, alone: {}.\n# {}\ntitle = {}\n\n", place_of(failure, path),
                    failure.reason, toml_text(fmt::format("Failed step {} of: {}", failure.step, path.title)));
    if (!path.plugin_paths.empty()) {
        std::vector<std::string> folders;
        for (const fs::path& folder : path.plugin_paths)
            folders.push_back(folder.string());
        text += fmt::format("[plugins]\npaths = {}\n\n", toml_text(folders));
    }
    text += material_text(path, before);
    std::vector<double> stress;
    std::ranges::copy(components(before.stress()), std::back_inserter(stress));
    text += fmt::format("\n[initial]\nstress = {}\nsuction = {}\nsaturation = {}\n\n[initial.state]\n{}\n\n",
                        toml_text(stress), toml_text(before.suction()), toml_text(before.saturation()),
                        state_list(before, "\n"));
    return text + stage_text(failure, path.stages.at(failure.stage - 1));
}

std::string summary_line(const PathDescription& path, const PathRecord& record)
{
    const PathRow& last = record.rows.back();
    const SymmetricTensor<double> stress = last.point.stress();
    const SymmetricTensor<double> strain = last.point.strain();
    std::string text = fmt::format("{} steps, {:.4g} s: p = {:.4g} kPa, q = {:.4g} kPa, volumetric compression {:.4g}, "
                                   "shear strain {:.4g}",
                                   last.step, last.time, 1e-3 * mean_pressure(stress), 1e-3 * deviator_stress(stress),
                                   0.0 - trace(strain), equivalent_shear_strain(strain));
    if (const std::optional<double> volume = specific_volume(path, last.point))
        text += fmt::format(", void ratio {:.4g}", *volume - 1.0);
    return text;
}

std::string failure_text(const PathDescription& path, const PathRecord& record)
{
    const FailedStep& failure = record.failure.value();
    const PathRow& before = record.rows.back();
    return fmt::format("{}, from t = {:.6g} s: {}\n"
                       "before this step:\n  effective stress [Pa]: {}\n  strain [-]: {}\n  state: {}",
                       place_of(failure, path), before.time, failure.reason,
                       component_list(all_components(before.point.stress())),
                       component_list(all_components(before.point.strain())), state_list(before.point, ", "));
}

void write_path_results(const PathDescription& path, const PathRecord& record, const fs::path& folder)
{
    fs::create_directories(folder);
    for (const char* name : path_result_names)
        fs::remove(folder / name);
    write_whole(folder / "path.toml", path.resolved);
    write_whole(folder / "path.csv", path_table(path, record));
    if (const std::string surfaces = yield_surface_table(record); !surfaces.empty())
        write_whole(folder / "yield_surface.csv", surfaces);
    if (record.failure)
        write_whole(folder / "failing_step.toml", failing_step_text(path, record));
}

} // namespace periporo
