// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// A case file after reading and checking: plain values in SI, nothing left to doubt.
#pragma once

#include "case/choices.hpp"
#include "periporo/parameters.hpp"
#include "periporo/tensor.hpp"

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace periporo {

/// A plugin asked for by name, with its checked parameters.
struct PluginChoice {
    std::string name;
    Parameters parameters;
};

struct DiscretizationDescription {
    double spacing = 0.0;         ///< dx [m]
    double horizon_ratio = 3.015; ///< delta/dx [-]
    RefreshRule refresh = RefreshRule::when_needed;
    double skin_ratio = 0.1; ///< relative displacement over dx after which families are found anew [-]

    double horizon() const { return horizon_ratio * spacing; } ///< [m]
    double skin() const { return skin_ratio * spacing; }       ///< [m]
};

struct OperatorDescription {
    std::string force_state = "energy_conjugate";
    std::string influence = "linear";
};

struct TimeDescription {
    double safety = 0.85;       ///< on the stable step [-]
    std::optional<double> step; ///< a fixed step instead of the computed one [s]
};

struct MaterialDescription {
    std::string name;
    PluginChoice model;
    std::optional<PluginChoice> retention; ///< curve of S_r over the suction
    double grain_density = 0.0;            ///< rho_s [kg/m3]
    double porosity = 0.0;                 ///< phi0 [-]
};

/// `PlaneDescription::axis` of a circular cylinder about the z axis, "r = 100 mm".
inline constexpr int cylinder_axis = 3;

/// A coordinate plane "x = 100 mm", or, as a roller, a cylinder "r = 100 mm".
struct PlaneDescription {
    int axis = 0;        ///< 0 x, 1 y, 2 z, or cylinder_axis
    double offset = 0.0; ///< position or radius [m]
};

/// The water in the pores of a body, and around it below a water table. "Dry", S_r = 0 and s = 0, is a state of its
/// own: the curve of a material gives S_r = 1 at s = 0.
struct WaterDescription {
    WaterKind kind = WaterKind::dry;
    double suction = 0.0;             ///< uniform: s >= 0 [Pa]
    PlaneDescription water_table;     ///< hydrostatic: where the pore pressure is zero
    std::optional<double> largest;    ///< hydrostatic: bound on s [Pa]
    std::string file;                 ///< field: CSV of places and suctions
    std::optional<double> saturation; ///< S_r, of a material without a curve [-]
};

struct InitialStressDescription {
    InitialStressKind kind = InitialStressKind::zero;
    double lateral_coefficient = 0.0;     ///< K0 [-]
    double overconsolidation_ratio = 1.0; ///< OCR [-]
};

/// A shape by name, for geometries made of others and for regions.
struct GeometryDescription {
    std::string name;
    PluginChoice plugin;
};

/// How points fill a body.
struct FillDescription {
    FillKind kind = FillKind::lattice;
    LatticeAxes align = LatticeAxes::body;
    double amplitude = 0.2;       ///< jittered: largest shift of a point along each axis, in spacings [-]
    std::int64_t iterations = 20; ///< relaxed: most iterations of Lloyd's method
    std::int64_t seed = 1;        ///< of the random numbers
};

struct BodyDescription {
    std::string name;
    PluginChoice geometry;
    FillDescription fill;
    std::string material;
    WaterDescription water;
    Vector3 velocity = Vector3::Zero();                    ///< of the centre of mass at the start [m/s]
    Vector3 angular_velocity = Vector3::Zero();            ///< about the centre of mass, at the start [rad/s]
    Eigen::Matrix3d strain_rate = Eigen::Matrix3d::Zero(); ///< about the centre of mass, at the start, symmetric [1/s]
    InitialStressDescription initial_stress;
};

/// What makes images of points.
struct BoundaryDescription {
    ImageKind kind = ImageKind::symmetry;
    PlaneDescription plane; ///< of a symmetry; the lower side of a periodic pair
    double period = 0.0;    ///< distance between the sides of a periodic pair [m]
    std::string key;        ///< of its place, "boundary.0"
};

/// Points with a prescribed motion. Every condition that is given must hold at the start of the run.
struct HeldRegionDescription {
    HeldKind kind = HeldKind::fixed;
    std::optional<PlaneDescription> below; ///< coordinates smaller than that of the plane
    std::vector<PlaneDescription> layer;   ///< none, or two: coordinates from that of the one to that of the other
    std::string within;                    ///< name of a geometry, or empty
    std::string body;                      ///< or empty
    Vector3 direction = Vector3::Zero();   ///< of a roller, a unit vector: the points do not move along it
    Vector3 velocity = Vector3::Zero();    ///< of a moving region [m/s]
    std::vector<std::string> stages;       ///< in which the points are held; empty: all
    std::string key;                       ///< of its place, "boundary.0"
};

/// A rigid thing that bodies touch.
struct ObstacleDescription {
    std::string name;
    PluginChoice geometry;
    Vector3 velocity = Vector3::Zero();               ///< while it moves [m/s]
    std::optional<std::vector<std::string>> moves_in; ///< stages; none given: all dynamic ones
    std::vector<std::string> stages;                  ///< in which it is there; empty: all
};

struct ContactDescription {
    PluginChoice law;
    std::vector<std::string> between; ///< one body (against the law's own surface), two bodies, a body and an obstacle,
                                      ///< or one body twice (its free grains)
    std::string surface;              ///< the body whose smoothed surface is touched, or empty
    bool crossing_stops = true;       ///< a point that goes through the obstacle stops the run; or it is a warning
};

/// What the water of a body becomes during a stage.
struct WaterChangeDescription {
    std::string body;
    WaterDescription water;
    double over = 0.0; ///< time in which the suction changes, evenly; 0 at once [s]
};

struct StageDescription {
    std::string name;
    StageType kind = StageType::dynamic;
    std::vector<PlaneDescription> rollers; ///< frictionless walls during this stage: planes are symmetry planes, a
                                           ///< cylinder holds the radial velocity of the points beside it
    double residual = 1e-3;                ///< |unbalanced force|/|gravity| to reach; dynamic: on the mean [-]
    double damping = 0.8;                  ///< quasi_static: coefficient of combined local damping [-]
    std::int64_t maximum_steps = 20000;    ///< quasi_static
    MaterialResponse response = MaterialResponse::elastic; ///< quasi_static
    double duration = 0.0;                                 ///< dynamic [s]
    std::optional<double> rest_speed; ///< dynamic: ends early when all bodies have come to rest below it [m/s]
    std::vector<WaterChangeDescription> water_changes;
};

struct OutputDescription {
    PluginChoice writer;
    double every = 0.0;        ///< interval of snapshots in dynamic stages [s]
    std::vector<double> times; ///< further times [s]
};

/// A published law the outcome is held against (data/laws of the tools), e.g. "axisymmetric_column".
struct ComparisonDescription {
    std::string law;
    double radius = 0.0; ///< r0, or half-width d0 [m]
    double height = 0.0; ///< h0 [m]
};

/// A file that a run reads, and what it is to the case: "case", "include", "plugin material sand",
/// "body.soil.water.file".
struct InputFile {
    std::string role;
    std::filesystem::path file;
};

struct CaseDescription {
    std::filesystem::path file;
    std::vector<InputFile> inputs;             ///< every file that the case consists of or names
    std::map<std::string, std::string> places; ///< "case.toml:12:1" of "body.soil", "stage.0", "gravity"; for messages
    std::string title;
    Vector3 gravity{0.0, 0.0, -9.81};
    DiscretizationDescription discretization;
    OperatorDescription operators;
    TimeDescription time;
    std::vector<MaterialDescription> materials;
    std::vector<BodyDescription> bodies;
    std::vector<GeometryDescription> geometries;
    std::vector<ObstacleDescription> obstacles;
    std::vector<BoundaryDescription> boundaries;
    std::vector<HeldRegionDescription> held_regions;
    std::vector<ContactDescription> contacts;
    std::vector<StageDescription> stages;
    std::vector<OutputDescription> outputs;
    std::optional<ComparisonDescription> comparison;
    double checkpoint_every = 60.0;  ///< wall-clock seconds between checkpoints [s]
    double history_every = 1e-3;     ///< simulated time between history rows [s]
    double energy_error_limit = 0.1; ///< over the energy turned over, beyond which the run stops [-]
    std::vector<std::filesystem::path> plugin_paths;
    std::string resolved; ///< the whole case as TOML, reproducing the run by itself
    std::vector<std::string> warnings;
};

/// The material of a body.
inline const MaterialDescription& material_of(const CaseDescription& description, const BodyDescription& body)
{
    return *std::ranges::find(description.materials, body.material, &MaterialDescription::name);
}

} // namespace periporo
