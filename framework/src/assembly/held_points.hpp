// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Points whose motion a case prescribes.
#pragma once

#include "assembly/geometries.hpp"
#include "case/description.hpp"
#include "model/model.hpp"
#include "time/dynamics.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace periporo {

/// Does what is listed for some stages, or for all by an empty list, apply in this one?
bool applies_in(const std::vector<std::string>& stages, const StageDescription& stage);

/// Points of the region at the start of the run.
/// @throws std::runtime_error when there are none, or when a region that does not move holds all of the model.
std::vector<std::uint32_t> points_of_region(const Model& model, const HeldRegionDescription& region,
                                            Geometries& geometries);

/// "12 points are fixed, those of body 'soil', z < 0.01 m"
std::string describe_region(const HeldRegionDescription& region, std::size_t points);

/// A plane roller is a mirror for all of the model.
/// @throws std::runtime_error when points lie on both sides of one.
void check_rollers(const Model& model, const StageDescription& stage);

/// What is held in a stage: the points of the regions, and the points at the cylindrical rollers of the stage ("r = 100
/// mm", about the z axis), within one spacing of the outermost ring, in the radial direction. The directions of a point
/// are orthogonal to each other, and lie side by side.
/// @throws std::runtime_error when a point is held twice along one direction, at different speeds.
std::vector<HeldDirection> held_directions(const Model& model, const CaseDescription& description,
                                           const std::vector<std::vector<std::uint32_t>>& regions,
                                           const StageDescription& stage);

} // namespace periporo
