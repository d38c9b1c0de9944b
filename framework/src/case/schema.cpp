// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The parameter records of every section of a case file.
#include "case/schema.hpp"

#include "case/description.hpp"
#include "plugins/built_in.hpp"

#include <algorithm>
#include <iterator>

namespace periporo {
namespace {

TableRules discretization_rules()
{
    return {{Parameter::real("spacing", dimension::length, "Distance dx between material points").above(0.0),
             Parameter::real("horizon", dimension::none, "Horizon delta in spacings")
                 .above(1.0)
                 .by_default(DiscretizationDescription{}.horizon_ratio),
             Parameter::text("refresh", "When families are found anew")
                 .one_of(choice_names<RefreshRule>())
                 .by_default(name_of(DiscretizationDescription{}.refresh)),
             Parameter::real("skin", dimension::none,
                             "Relative displacement in spacings after which families are found anew")
                 .above(0.0)
                 .at_most(1.0)
                 .by_default(DiscretizationDescription{}.skin_ratio)}};
}

TableRules operator_rules()
{
    return {{Parameter::text("force_state", "Force state of the periporomechanics operator")
                 .one_of(force_state_names())
                 .by_default(OperatorDescription{}.force_state.c_str()),
             Parameter::text("influence", "Influence function over the length of a bond")
                 .one_of(influence_names())
                 .by_default(OperatorDescription{}.influence.c_str())}};
}

TableRules time_rules()
{
    return {{Parameter::real("safety", dimension::none, "Factor on the stable time step")
                 .above(0.0)
                 .at_most(1.0)
                 .by_default(TimeDescription{}.safety),
             Parameter::real("step", dimension::time,
                             "Fixed time step instead of the computed one; refused when it is not stable")
                 .above(0.0)
                 .optional()}};
}

TableRules retention_rules()
{
    TableRules rules{{Parameter::text("curve", "Retention plugin")}};
    rules.selector = "curve";
    rules.plugin = PluginKind::retention;
    return rules;
}

TableRules material_rules()
{
    TableRules rules{{Parameter::text("model", "Material plugin"),
                      Parameter::real("grain_density", dimension::density, "Density rho_s of the grains").above(0.0),
                      Parameter::real("porosity", dimension::none, "Initial porosity phi0").at_least(0.0).below(1.0)}};
    rules.selector = "model";
    rules.plugin = PluginKind::material;
    rules.nested = {{"retention", TableShape::single, TablePresence::optional,
                     "Water retention curve: the degree of saturation that a suction means", retention_rules()}};
    return rules;
}

TableRules geometry_rules()
{
    TableRules rules{{Parameter::text("generator", "Geometry plugin")}};
    rules.selector = "generator";
    rules.plugin = PluginKind::geometry;
    return rules;
}

TableRules fill_rules()
{
    TableRules rules{{Parameter::text("type", "How points lie")
                          .one_of(choice_names<FillKind>())
                          .by_default(name_of(FillDescription{}.kind)),
                      Parameter::text("align", "Lattice along the axes of the body or of the coordinates")
                          .one_of(choice_names<LatticeAxes>())
                          .by_default(name_of(FillDescription{}.align))}};
    const Parameter seed =
        Parameter::integer("seed", "Of the random numbers").at_least(0).by_default(FillDescription{}.seed);
    const Parameter amplitude =
        Parameter::real("amplitude", dimension::none, "Largest shift along each axis, in spacings")
            .above(0.0)
            .below(0.5)
            .by_default(FillDescription{}.amplitude);
    rules.selector = "type";
    rules.variants = {
        {"lattice", {}},
        {"jittered", {{amplitude, seed}}},
        {"relaxed",
         {{seed, Parameter::integer("iterations", "Most iterations of Lloyd's method")
                     .at_least(1)
                     .by_default(FillDescription{}.iterations)}}},
    };
    return rules;
}

TableRules initial_stress_rules()
{
    TableRules rules{{Parameter::text("type", "Effective stress at the start")
                          .one_of(choice_names<InitialStressKind>())
                          .by_default(name_of(InitialStressDescription{}.kind))}};
    rules.selector = "type";
    rules.variants = {
        {"zero", {}},
        {"geostatic",
         {{Parameter::real("K0", dimension::none, "Coefficient of earth pressure at rest").at_least(0.0),
           Parameter::real("overconsolidation_ratio", dimension::none, "Overconsolidation ratio OCR")
               .at_least(1.0)
               .by_default(InitialStressDescription{}.overconsolidation_ratio)}}},
    };
    return rules;
}

/// The water of a body, or what it becomes: then `further` says of which body and how.
TableRules water_rules(std::vector<Parameter> further = {})
{
    const Parameter saturation =
        Parameter::real("saturation", dimension::none,
                        "Degree of saturation S_r, of a material without a retention curve; 1 below a "
                        "water table")
            .at_least(0.0)
            .at_most(1.0)
            .optional();
    TableRules rules{{Parameter::text("type", "Where the pore pressure comes from")
                          .one_of(choice_names<WaterKind>())
                          .by_default(name_of(WaterDescription{}.kind))}};
    for (Parameter& parameter : further)
        rules.parameters.push_back(std::move(parameter));
    TableRules hydrostatic{
        {Parameter::text("water_table",
                         "Plane of zero pore pressure, \"z = -2 m\": suction above, standing water below"),
         Parameter::real("largest_suction", dimension::pressure, "Suction that is nowhere exceeded")
             .above(0.0)
             .optional(),
         saturation}};
    hydrostatic.planes = {"water_table"};
    rules.selector = "type";
    rules.variants = {
        {"dry", {}},
        {"uniform", {{Parameter::real("suction", dimension::pressure, "Suction s").at_least(0.0), saturation}}},
        {"hydrostatic", hydrostatic},
        {"field",
         {{Parameter::file("file", "CSV with columns x, y, z [m] and suction [Pa]; a point takes the nearest row"),
           saturation}}},
    };
    return rules;
}

TableRules body_rules()
{
    TableRules rules{
        {Parameter::text("material", "Name of a [material.NAME]"),
         Parameter::real_list("velocity", dimension::velocity, 3, "Initial velocity").by_default({0.0, 0.0, 0.0}),
         Parameter::real_list("angular_velocity", dimension::angular_velocity, 3,
                              "Initial angular velocity about the centre of mass")
             .by_default({0.0, 0.0, 0.0}),
         Parameter::real_list("strain_rate", dimension::rate, 6,
                              "Initial rate of deformation about the centre of mass: xx, yy, zz, xy, yz, xz, as in "
                              "\"20 s^-1\"")
             .by_default({0.0, 0.0, 0.0, 0.0, 0.0, 0.0})}};
    rules.nested = {
        {"geometry", TableShape::single, TablePresence::required, "The region that the body fills", geometry_rules()},
        {"initial_stress", TableShape::single, TablePresence::defaulted, "Effective stress at the start",
         initial_stress_rules()},
        {"water", TableShape::single, TablePresence::defaulted, "Suction and saturation at the start", water_rules()},
        {"fill", TableShape::single, TablePresence::defaulted, "How points fill the region", fill_rules()}};
    return rules;
}

Parameter plane_parameter(const char* documentation)
{
    return Parameter::text("plane", documentation);
}

/// Which points a prescribed motion concerns, and when. Whatever is given must hold for a point at the start of the
/// run.
std::vector<Parameter> held_region_parameters()
{
    return {plane_parameter("Points of smaller coordinates, \"z = 0 mm\"").optional(),
            Parameter::text_list("layer", 2, "Points between two planes, [\"z = 0 mm\", \"z = 20 mm\"]").optional(),
            Parameter::text("within", "Points in a [geometry.NAME]").optional(),
            Parameter::text("body", "Points of a body").optional(),
            Parameter::text_list("stages", 0, "Stages in which the points are held; all when left out").optional()};
}

TableRules held_region_rules(std::vector<Parameter> further = {})
{
    TableRules rules{std::move(further)};
    for (Parameter& parameter : held_region_parameters())
        rules.parameters.push_back(std::move(parameter));
    rules.planes = {"plane", "layer"};
    return rules;
}

TableRules image_rules(Parameter plane, std::vector<Parameter> further = {})
{
    TableRules rules{{std::move(plane)}};
    for (Parameter& parameter : further)
        rules.parameters.push_back(std::move(parameter));
    rules.planes = {"plane"};
    return rules;
}

/// Boundaries that make images of points, then those that prescribe the motion of points.
std::vector<std::string> boundary_types()
{
    std::vector<std::string> types = choice_names<ImageKind>();
    std::ranges::move(choice_names<HeldKind>(), std::back_inserter(types));
    return types;
}

TableRules boundary_rules()
{
    TableRules rules{{Parameter::text("type", "Kind of boundary").one_of(boundary_types())}};
    rules.selector = "type";
    rules.variants = {
        {"symmetry", image_rules(plane_parameter("Symmetry plane, \"x = 0 mm\""))},
        {"periodic",
         image_rules(plane_parameter("Lower side of the periodic pair, \"y = 0 mm\""),
                     {Parameter::real("period", dimension::length, "Distance between the sides").above(0.0)})},
        {"fixed", held_region_rules()},
        {"roller", held_region_rules({Parameter::real_list("direction", dimension::none, 3,
                                                           "Direction in which the points cannot move")})},
        {"moving", held_region_rules(
                       {Parameter::real_list("velocity", dimension::velocity, 3, "Velocity that the points have")})},
    };
    return rules;
}

TableRules obstacle_rules()
{
    TableRules rules{
        {Parameter::real_list("velocity", dimension::velocity, 3, "Velocity while it moves")
             .by_default({0.0, 0.0, 0.0}),
         Parameter::text_list("moves_in", 0, "Stages in which it moves; all dynamic ones when left out").optional(),
         Parameter::text_list("stages", 0, "Stages in which it is there; all when left out").optional()}};
    rules.nested = {{"geometry", TableShape::single, TablePresence::required, "Its shape", geometry_rules()}};
    return rules;
}

TableRules contact_rules()
{
    TableRules rules{{Parameter::text("law", "Contact plugin"),
                      Parameter::text_list("between", 0,
                                           "One body, against the surface of the law; two bodies; a body and an "
                                           "obstacle; or one body twice, for its free grains"),
                      Parameter::text("surface", "Of two bodies the one whose smoothed surface the other touches, with "
                                                 "the reaction along its normal; when left out, point touches point")
                          .optional(),
                      Parameter::text("crossing", "When a point has gone through the obstacle: stop the run, or warn "
                                                  "and let go of the point")
                          .one_of({"stop", "warn"})
                          .by_default("stop")}};
    rules.selector = "law";
    rules.plugin = PluginKind::contact;
    return rules;
}

TableRules quasi_static_rules()
{
    TableRules rules{
        {Parameter::text_list("rollers", 0, "Frictionless walls during the stage, [\"x = 100 mm\"] or [\"r = 100 mm\"]")
             .optional(),
         Parameter::real("damping", dimension::none, "Coefficient of combined local damping")
             .above(0.0)
             .below(1.0)
             .by_default(StageDescription{}.damping),
         Parameter::integer("maximum_steps", "Steps after which the stage has failed")
             .at_least(1)
             .by_default(StageDescription{}.maximum_steps),
         Parameter::text("response", "Material response while settling")
             .one_of(choice_names<MaterialResponse>())
             .by_default(name_of(StageDescription{}.response))}};
    rules.planes = {"rollers"};
    rules.nested = {
        {"until",
         TableShape::single,
         TablePresence::defaulted,
         "When the stage has settled",
         {{Parameter::real("residual", dimension::none, "Norm of internal plus external force over that of gravity")
               .above(0.0)
               .below(1.0)
               .by_default(StageDescription{}.residual)}}}};
    return rules;
}

TableRules dynamic_rules()
{
    TableRules rules{{Parameter::real("duration", dimension::time, "Simulated time of the stage").above(0.0)}};
    rules.nested = {
        {"until",
         TableShape::single,
         TablePresence::defaulted,
         "What ends the stage before its duration",
         {{Parameter::real(
               "rest_speed", dimension::velocity,
               "Mean speed of every body below which the stage may end: when its motion has died away, does "
               "not grow and its forces balance, a time of fall over the height of the model after the "
               "water has changed; without gravity, or where something is driven, once a body has moved "
               "at twice this speed")
               .above(0.0)
               .optional(),
           Parameter::real("residual", dimension::none,
                           "With rest_speed: norm of the unbalanced force, a mean over an eighth of that time, over "
                           "that of gravity, below which forces balance; 0.01 when left out")
               .above(0.0)
               .below(1.0)
               .optional()}}}};
    return rules;
}

TableRules stage_rules()
{
    TableRules rules{{Parameter::text("name", "Name of the stage, used once"),
                      Parameter::text("type", "Kind of stage").one_of(choice_names<StageType>())}};
    rules.nested = {
        {"water", TableShape::list, TablePresence::optional, "What the water of a body becomes during the stage",
         water_rules({Parameter::text("body", "The body"),
                      Parameter::real("over", dimension::time,
                                      "Time in which the suction changes, evenly; the duration of the stage when left "
                                      "out, at once in a quasi-static one")
                          .above(0.0)
                          .optional()})}};
    rules.selector = "type";
    rules.variants = {{"quasi_static", quasi_static_rules()}, {"dynamic", dynamic_rules()}};
    return rules;
}

TableRules output_rules()
{
    TableRules rules{
        {Parameter::text("writer", "Output plugin"),
         Parameter::real("every", dimension::time, "Simulated time between snapshots").above(0.0).optional(),
         Parameter::real_list("times", dimension::time, 0, "Further times of snapshots").at_least(0.0).optional()}};
    rules.selector = "writer";
    rules.plugin = PluginKind::output;
    return rules;
}

TableRules comparison_rules()
{
    return {{Parameter::text("law", "Published law that the outcome is held against")
                 .one_of({"axisymmetric_column", "planar_column"}),
             Parameter::real("radius", dimension::length, "Initial radius r0, or half-width d0").above(0.0),
             Parameter::real("height", dimension::length, "Initial height h0").above(0.0)}};
}

TableRules plugins_rules()
{
    return {{Parameter::text_list("paths", 0, "Folders of plugin libraries, relative to this file").optional()}};
}

TableRules run_rules()
{
    return {{Parameter::real(
                 "checkpoint_every", dimension::time,
                 "Wall-clock time between checkpoints; longer where they would take more than a twentieth of it; 0 for "
                 "one after every step, whatever it takes")
                 .at_least(0.0)
                 .by_default(CaseDescription{}.checkpoint_every),
             Parameter::real("history_every", dimension::time, "Simulated time between rows of the history")
                 .above(0.0)
                 .by_default(CaseDescription{}.history_every),
             Parameter::real("energy_error_limit", dimension::none,
                             "Energy error, over the energy turned over, beyond which a run stops")
                 .above(0.0)
                 .by_default(CaseDescription{}.energy_error_limit)}};
}

TableRules root_rules()
{
    using enum TableShape;
    using enum TablePresence;
    TableRules rules{{Parameter::text("title", "One line that says what is simulated"),
                      Parameter::real_list("gravity", dimension::acceleration, 3, "Acceleration of gravity")
                          .by_default({0.0, 0.0, -9.81})}};
    rules.nested = {
        {"plugins", single, defaulted, "Where further plugins are", plugins_rules()},
        {"discretization", single, required, "Material points and their families", discretization_rules()},
        {"operator", single, defaulted, "The periporomechanics operator", operator_rules()},
        {"time", single, defaulted, "The time step", time_rules()},
        {"material", named, required, "A material", material_rules()},
        {"body", named, required, "A body of one material", body_rules()},
        {"geometry", named, optional, "A shape that others are made of, or a region of points", geometry_rules()},
        {"obstacle", named, optional, "A rigid thing that bodies touch, at rest or moving", obstacle_rules()},
        {"boundary", list, optional, "A symmetry plane, a periodic pair or points with a prescribed motion",
         boundary_rules()},
        {"contact", list, optional, "A contact law between bodies, or a body and a surface", contact_rules()},
        {"stage", list, required, "A stage of the run, in order", stage_rules()},
        {"output", list, optional, "A writer of results", output_rules()},
        {"comparison", single, optional, "A published law to compare with", comparison_rules()},
        {"run", single, defaulted, "Bookkeeping of the run", run_rules()},
    };
    return rules;
}

} // namespace

const TableRules& case_rules()
{
    static const TableRules rules = root_rules();
    return rules;
}

} // namespace periporo
