// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Leads a material point along a path.
#pragma once

#include "drive/path_description.hpp"
#include "periporo/material_point.hpp"
#include "periporo/retention.hpp"

#include <optional>
#include <string>
#include <vector>

namespace periporo {

/// The point after a step; the first row of a path is its start.
struct PathRow {
    std::size_t step = 0;  ///< over all stages, 0 at the start
    std::size_t stage = 0; ///< from 1; 0 at the start
    double time = 0.0;     ///< [s]
    MaterialPoint point;
};

/// A step that the law, or the search for the strains of the controlled stresses, could not make, not even in parts.
struct FailedStep {
    std::size_t step = 0;
    std::size_t stage = 0; ///< from 1
    MixedStage increment;  ///< the step as a stage of its own
    double time_step = 0.0;
    std::string reason;
};

/// The outcome of a path: rows up to its end, or up to the last step before the one that failed.
struct PathRecord {
    std::vector<PathRow> rows;
    std::optional<FailedStep> failure;
};

/// Specific volume v = 1/(1 - phi0) exp(tr eps) [-], where phi0 is known: strains are logarithmic, as sums of D dt are.
std::optional<double> specific_volume(const PathDescription& path, const MaterialPoint& point);

/// The point as a path starts: state variables by the law from the OCR, then those that the path gives.
/// @param curve of the material, null when it has none
/// @throws std::runtime_error when the law gives a state that is not finite.
MaterialPoint initial_point(const PathDescription& path, const Material& material, const Retention* curve = nullptr);

/// Makes all steps of all stages. The material must outlive the record. With a curve the saturation is that of the
/// suction at the end of a step and of the porosity at its beginning.
PathRecord drive_path(const PathDescription& path, const Material& material, const Retention* curve = nullptr);

} // namespace periporo
