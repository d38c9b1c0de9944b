// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The parameter records of every section of a path.
#include "drive/path_schema.hpp"

#include "periporo/tensor.hpp"

#include <algorithm>
#include <stdexcept>

namespace periporo {
namespace {

const TableRules& rules_of_case_table(const std::string& name)
{
    const std::vector<NestedRules>& nested = case_rules().nested;
    return std::find_if(nested.begin(), nested.end(), [&](const NestedRules& rules) { return rules.name == name; })
        ->rules;
}

TableRules material_rules()
{
    TableRules rules = rules_of_case_table("material");
    for (Parameter& record : rules.parameters)
        if (record.name == "porosity" || record.name == "grain_density")
            record = std::move(record).optional();
    return rules;
}

/// Most state variables are pure numbers or logarithms; those with a unit of their own accept it.
Dimension dimension_of(const StateVariable& variable)
{
    try {
        return parse_quantity("1 " + variable.unit).dimension;
    } catch (const std::invalid_argument&) {
        return dimension::none;
    }
}

std::vector<Parameter> suction_records()
{
    return {Parameter::real("suction", dimension::pressure, "Suction s").at_least(0.0),
            Parameter::real("saturation", dimension::none,
                            "Degree of saturation S_r, of a material without a retention curve")
                .at_least(0.0)
                .at_most(1.0)};
}

TableRules initial_rules(const std::vector<StateVariable>& state_variables)
{
    TableRules rules{
        {Parameter::real("pressure", dimension::pressure, "Isotropic effective pressure, compression positive")
             .at_least(0.0)
             .optional(),
         Parameter::real_list("stress", dimension::pressure, 6,
                              "Effective stress xx, yy, zz, xy, yz, xz, tension positive")
             .optional(),
         Parameter::real("overconsolidation_ratio", dimension::none,
                         "Overconsolidation ratio OCR from which the law sets its state")
             .at_least(1.0)
             .by_default(1.0)}};
    for (Parameter& record : suction_records())
        rules.parameters.push_back(std::move(record).optional());
    TableRules state;
    for (const StateVariable& variable : state_variables)
        state.parameters.push_back(
            Parameter::real(variable.name, dimension_of(variable), variable.description).optional());
    rules.nested = {{"state", TableShape::single, TablePresence::defaulted,
                     "State variables of the law that do not follow from the OCR", std::move(state)}};
    return rules;
}

Parameter duration()
{
    return Parameter::real("duration", dimension::time, "Time for one way to the target").above(0.0);
}

/// Two targets of which a stage has one.
std::vector<Parameter> either(Parameter first, Parameter second)
{
    return {std::move(first).optional(), std::move(second).optional()};
}

/// Keys of a stage that may run at a rate of strain.
std::vector<Parameter> with_rate(std::vector<Parameter> targets)
{
    targets.push_back(duration().optional());
    targets.push_back(
        Parameter::real("strain_rate", dimension::rate, "Rate of the strain that is the target, instead of a duration")
            .above(0.0)
            .optional());
    return targets;
}

TableRules simple_shear_rules()
{
    TableRules rules{with_rate(either(
        Parameter::real(
            "shear_strain", dimension::none,
            "Shear gamma of planes z = const. that slide along x, change in the stage; the stress turns with "
            "the spin of this motion"),
        Parameter::real("shear_stress", dimension::pressure,
                        "Shear stress xz of the horizontal plane at the end; the stress turns with the shear that it "
                        "takes")))};
    rules.parameters.push_back(
        Parameter::text("vertical", "What is held in the direction z").one_of({"constant_stress", "constant_height"}));
    return rules;
}

TableRules true_triaxial_rules()
{
    return {{Parameter::real_list("pressures", dimension::pressure, 3,
                                  "Effective pressures in x, y and z at the end, compression positive")
                 .optional(),
             Parameter::real_list("compressions", dimension::none, 3,
                                  "Strains in x, y and z, compression positive, change in the stage")
                 .optional(),
             duration()}};
}

TableRules suction_rules()
{
    TableRules rules;
    for (Parameter& record : suction_records())
        rules.parameters.push_back(std::move(record).optional());
    rules.parameters.push_back(
        Parameter::text("held", "Which stress stays").one_of({"total_stress", "effective_stress"}));
    rules.parameters.push_back(duration());
    return rules;
}

TableRules component_rules(Dimension dimension, const std::string& what)
{
    TableRules rules;
    for (const char* component : symmetric_component_names)
        rules.parameters.push_back(Parameter::real(component, dimension, what + component).optional());
    return rules;
}

TableRules mixed_rules()
{
    TableRules rules{{Parameter::text_list("held_stress", 0, "Components whose stress stays")
                          .one_of(std::vector<std::string>(std::begin(symmetric_component_names),
                                                           std::end(symmetric_component_names)))
                          .optional(),
                      Parameter::text("motion", "What turns: nothing, shear strains are pure; or the point with the "
                                                "shear xz, of planes z = const. that slide along x")
                          .one_of({"irrotational", "simple_shear"})
                          .by_default("irrotational"),
                      duration()}};
    for (Parameter& record : suction_records())
        rules.parameters.push_back(std::move(record).optional());
    rules.nested = {{"strain", TableShape::single, TablePresence::defaulted,
                     "Change of strain components, extension positive; those named nowhere stay",
                     component_rules(dimension::none, "Change of strain component ")},
                    {"stress", TableShape::single, TablePresence::defaulted,
                     "Effective stress components at the end, tension positive",
                     component_rules(dimension::pressure, "Effective stress component ")}};
    return rules;
}

TableRules stage_rules()
{
    const Parameter axial_compression = Parameter::real("axial_compression", dimension::none,
                                                        "Axial (z) strain, compression positive, change in the stage");
    TableRules rules{
        {Parameter::text("name", "Name of the stage, for messages").optional(),
         Parameter::text("type", "Kind of stage"),
         Parameter::integer("steps", "Increments for one way to the target").at_least(1).at_most(1e6).by_default(100),
         Parameter::integer("cycles", "0: to the target; n: n times to the target and back")
             .at_least(0)
             .at_most(1e6)
             .by_default(0),
         Parameter::boolean("two_way", "A cycle swings to the opposite side of the start too").by_default(false),
         Parameter::integer("halvings", "How often an increment that fails may be halved")
             .at_least(0)
             .at_most(20)
             .by_default(8)}};
    rules.selector = "type";
    rules.variants = {
        {"isotropic",
         with_rate(either(Parameter::real("volumetric_compression", dimension::none,
                                          "Volumetric strain, compression positive, change in the stage"),
                          Parameter::real("pressure", dimension::pressure, "Mean effective pressure at the end")))},
        {"oedometric",
         with_rate(either(axial_compression, Parameter::real("axial_pressure", dimension::pressure,
                                                             "Axial (z) effective pressure at the end")))},
        {"triaxial_drained",
         with_rate(either(axial_compression, Parameter::real("deviator_stress", dimension::pressure,
                                                             "Axial minus lateral pressure at the end")))},
        {"triaxial_undrained", with_rate({axial_compression})},
        {"simple_shear", simple_shear_rules()},
        {"true_triaxial", true_triaxial_rules()},
        {"suction", suction_rules()},
        {"mixed", mixed_rules()},
    };
    std::vector<std::string> types;
    for (const TableVariant& variant : rules.variants)
        types.push_back(variant.choice);
    rules.parameters[1] = std::move(rules.parameters[1]).one_of(std::move(types));
    return rules;
}

} // namespace

TableRules path_rules(const std::vector<StateVariable>& state_variables)
{
    using enum TableShape;
    using enum TablePresence;
    TableRules rules{{Parameter::text("title", "One line that says what is done")}};
    rules.nested = {
        {"plugins", single, defaulted, "Where further plugins are", rules_of_case_table("plugins")},
        {"material", named, required, "The material", material_rules()},
        {"initial", single, required, "The point at the start", initial_rules(state_variables)},
        {"stage", list, required, "A stage of the path, in order", stage_rules()},
    };
    return rules;
}

} // namespace periporo
