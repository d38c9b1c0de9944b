// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// A picture of a case before it is run: bodies, obstacles, boundaries, axes and sizes.
#pragma once

#include "case/description.hpp"
#include "plugins/registry.hpp"

#include "assembly/build_model.hpp"
#include "io/svg.hpp"
#include <filesystem>

#include <vector>

namespace periporo {

/// Points that something of their body does not hide on all six sides along the axes.
std::vector<std::uint32_t> visible_points(const Model& model);

/// Three views of the model at the start of the run: from the front, the right and above; from the front (x, z); from
/// above (x, y). Points are discs as wide as the spacing, in the colour of their body, dark-rimmed where their motion
/// is prescribed in the first stage; obstacles are grey.
SvgDrawing draw_set_up(const BuiltModel& built, const CaseDescription& description);

/// Draws the case as it begins into an SVG file; an older one is replaced.
/// @throws std::runtime_error naming the file when it cannot be written.
void draw_case(const CaseDescription& description, const PluginRegistry& registry, const std::filesystem::path& file);

} // namespace periporo
