// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// A path of one material point after reading and checking: plain values in SI, nothing left to doubt.
#pragma once

#include "case/description.hpp"
#include "periporo/tensor.hpp"

#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace periporo {

/// What the leading component of a stage reaches: a stress [Pa] or a change of strain [-], signed as the stage says.
struct StageTarget {
    double value = 0.0;
    bool is_stress = false;
};

// The kinds of stages. The axis is z, the lateral directions are x and y; all stresses are effective. Pressures and
// compressions count compression positive. Where nothing else is said shear strains stay as they are.

/// Equal changes of the three normal stresses until the mean pressure is reached, or of the three normal strains.
struct IsotropicStage {
    StageTarget target; ///< mean pressure p, or volumetric compression
};
/// No lateral strain.
struct OedometricStage {
    StageTarget target; ///< axial pressure, or axial compression
};
/// Lateral stresses held.
struct DrainedTriaxialStage {
    StageTarget target; ///< axial minus mean lateral pressure, or axial compression
};
/// Constant volume, equal lateral strains.
struct UndrainedTriaxialStage {
    double axial_compression = 0.0;
};
/// Planes z = const. slide along x, L = gamma_dot e_x (x) e_z, without lateral strain. The spin of this motion turns
/// the stress. Stresses are those of the horizontal plane and of fixed axes, also where they are controlled.
struct SimpleShearStage {
    StageTarget target;           ///< stress xz, or shear strain gamma = 2 eps_xz
    bool constant_height = false; ///< else the stress zz is held
};
/// The three normal stresses, or strains, each to its own value. Both are compression positive.
struct TrueTriaxialStage {
    bool stress_controlled = false;
    std::array<double, 3> targets{}; ///< of x, y and z: pressures [Pa] or compressions [-]
};
/// A change of the water at held total or effective stress; the total stress is effective + S_r s, tension-positive.
/// With a retention curve there is no saturation: it follows the suction.
struct SuctionStage {
    std::optional<double> suction;    ///< at the end [Pa]
    std::optional<double> saturation; ///< at the end [-]
    bool total_stress_held = false;
};
/// Each component (xx yy zz xy yz xz, tension-positive) on its own: to a stress, at held stress, or by a strain.
struct MixedStage {
    std::array<std::optional<double>, 6> stress; ///< at the end [Pa]
    std::array<bool, 6> stress_held{};
    std::array<double, 6> strain{}; ///< change where the stress is neither prescribed nor held [-]
    bool simple_shear = false;      ///< has the shear xz the spin of simple shear? Else no motion has a spin
    std::optional<double> suction;
    std::optional<double> saturation;
};

using StageKind = std::variant<IsotropicStage, OedometricStage, DrainedTriaxialStage, UndrainedTriaxialStage,
                               SimpleShearStage, TrueTriaxialStage, SuctionStage, MixedStage>;

struct PathStage {
    std::string name; ///< may be empty
    std::string type; ///< as in the file, "triaxial_drained"
    StageKind kind;
    double duration = 0.0;     ///< of one way to the target [s]
    std::int64_t steps = 100;  ///< increments of one way to the target
    std::int64_t cycles = 0;   ///< 0: to the target; n: n times to the target and back
    bool two_way = false;      ///< a cycle swings to the opposite side too
    std::int64_t halvings = 8; ///< how often an increment that fails may be halved
};

struct PathDescription {
    std::string title;
    std::string material_name;
    PluginChoice model;
    std::optional<PluginChoice> retention; ///< curve of S_r over the suction
    std::optional<double> grain_density;   ///< [kg/m3]; a point alone has no use for it
    std::optional<double> porosity;        ///< at the start [-]
    SymmetricTensor<double> stress;        ///< effective, at the start, tension-positive [Pa]
    double overconsolidation_ratio = 1.0;  ///< OCR from which the law sets its state [-]
    std::optional<double> suction;         ///< at the start; none: dry [Pa]
    std::optional<double> saturation;      ///< at the start, without a retention curve; none: dry [-]
    std::map<std::string, double> state;   ///< state variables that do not follow from the OCR
    std::vector<PathStage> stages;
    std::vector<std::filesystem::path> plugin_paths; ///< absolute, of the file and of the command line
    std::string resolved; ///< the whole file with all defaults, as TOML that reads back to the same path
    std::vector<std::string> warnings;
};

} // namespace periporo
