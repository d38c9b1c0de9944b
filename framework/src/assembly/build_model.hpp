// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// From a checked case to a model: points of all bodies, materials, contact laws, initial stress.
#pragma once

#include "assembly/geometries.hpp"
#include "case/description.hpp"
#include "contact/contact_forces.hpp"
#include "model/model.hpp"
#include "operator/force_state.hpp"
#include "plugins/registry.hpp"
#include "water/water.hpp"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace periporo {

/// The material of a body of the case, made by its plugin.
std::shared_ptr<const Material> make_material(const CaseDescription& description, const BodyDescription& body,
                                              const PluginRegistry& registry);

struct BuiltModel {
    Model model;
    Water water;
    std::vector<ContactAssignment> contacts;
    std::vector<std::vector<std::uint32_t>> held_regions; ///< points of each held region of the case
    std::vector<std::vector<Vector3>> cut_away; ///< of each body: places of the points that boundaries leave out [m]
    std::vector<std::string> remarks; ///< what a user should know: points cut away, mass against exact, repairs
};

/// Hears how much of a body is filled, from 0 to 1.
using BuildProgress = std::function<void(const std::string& body, double fraction)>;

/// Points of all bodies, cut at symmetry planes (the side of larger coordinates stays) and to periodic cells, in the
/// order of a space-filling curve.
/// @param geometries of the case, those that are made already included
/// @throws CaseError with all bodies, obstacles, regions and contacts that cannot be built.
BuiltModel build_model(const CaseDescription& description, const PluginRegistry& registry, Geometries& geometries,
                       const BuildProgress& progress = {});
/// The same with geometries of its own.
BuiltModel build_model(const CaseDescription& description, const PluginRegistry& registry);

/// Isometries of the boundaries of the case and the plane rollers of a stage.
std::vector<Isometry> image_generators(const CaseDescription& description, const StageDescription& stage);

/// Gives the obstacles of the case what they do in a stage.
void set_obstacles(Model& model, const CaseDescription& description, const StageDescription& stage);

/// Initial effective stress of all bonds (tension-positive, from the depth of the middle of the bond below the top of
/// its body: sigma_v = -(weight less buoyancy above, over the area) - S_r s, sigma_h = K0 sigma_v) and the state of the
/// materials that goes with it.
void set_initial_stress(Model& model, const ForceState& force_state, const CaseDescription& description);

/// State variables of all bonds from their stress and the overconsolidation ratio of the body.
void initialize_materials(Model& model, const ForceState& force_state);

} // namespace periporo
