// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Paths of one material point from text, with materials linked into the test.
#pragma once

#include "case_text.hpp"
#include "drive/path_driver.hpp"
#include "drive/path_reader.hpp"
#include "material/linear_elastic/linear_elastic.hpp"
#include "material/viscoplastic_critical_state/viscoplastic_critical_state.hpp"
#include "periporo/material_law.hpp"
#include "temporary_folder.hpp"

#include <doctest/doctest.h>

#include <memory>

namespace periporo::test {

/// Hooke's law that refuses increments of more than one per mille of strain: what only smaller steps can pass.
struct Impatient {
    static constexpr std::size_t state_count = 0;
    static constexpr double largest = 1e-3;
    static std::vector<Parameter> parameters() { return {}; }
    static std::vector<StateVariable> state_variables() { return {}; }
    explicit Impatient(const Parameters&) {}
    double bulk_modulus() const { return 2e6; }
    double shear_modulus() const { return 1.2e6; }
    template <class Real>
    LawResult<Real, 0> update(const LawInput<Real, 0>& old) const
    {
        LawResult<Real, 0> result{elastic_stress(old.stress, old.strain_increment, bulk_modulus(), shear_modulus()),
                                  {}};
        result.failed = norm(old.strain_increment) > Real(largest);
        result.reason = "the strain increment is too large";
        return result;
    }
    template <class Real>
    std::array<Real, 0> initial_state(const LawInput<Real, 0>&, double) const
    {
        return {};
    }
};

/// S_r = s_h/(s_h + e s) with the void ratio e: half at s = s_h/e.
struct Hyperbola : Retention {
    static std::vector<Parameter> parameters()
    {
        return {Parameter::real("half", dimension::pressure, "Suction s_h at which half is left, at e = 1").above(0.0)};
    }
    explicit Hyperbola(const Parameters& parameters) : half(parameters.real("half")) {}
    double saturation(double suction, double porosity) const override
    {
        return half / (half + porosity / (1.0 - porosity) * suction);
    }
    double half;
};

/// Laws of the project under names of their own, since those of the build are found too, and impatient.
inline PluginRegistry path_registry()
{
    static constexpr auto material = PluginKind::material;
    static const PluginDescriptor elastic =
        describe_plugin<material, LawMaterial<LinearElastic>>("hooke", "Hooke's law");
    static const PluginDescriptor silt =
        describe_plugin<material, LawMaterial<ViscoplasticCriticalState>>("paper_silt", "A soil");
    static const PluginDescriptor impatient =
        describe_plugin<material, LawMaterial<Impatient>>("impatient", "Hooke's law in small steps");
    static const PluginDescriptor hyperbola =
        describe_plugin<PluginKind::retention, Hyperbola>("hyperbola", "A curve of the void ratio");
    PluginRegistry registry;
    registry.add(hyperbola, "/test/hyperbola.so");
    registry.add(elastic, "/test/elastic.so");
    registry.add(silt, "/test/silt.so");
    registry.add(impatient, "/test/impatient.so");
    return registry;
}

/// K = 2 MPa and G = 1.2 MPa: E = 3 MPa and nu = 0.25.
inline const std::string rubber = R"(title = "an elastic path"
[material.rubber]
model = "hooke"
bulk_modulus = "2 MPa"
shear_modulus = "1.2 MPa"
)";

/// The soil of the paper, without viscosity.
inline const std::string silt = R"(title = "a path of the paper's silt"
[material.silt]
model = "paper_silt"
bulk_modulus = "25 MPa"
shear_modulus = "15 MPa"
critical_state_slope = 1.1
compression_index = 0.12
swelling_index = 0.04
viscosity = 0
)";

inline PathDescription read_path_text(const std::string& text, const std::vector<std::string>& overrides = {})
{
    const TemporaryFolder folder;
    write_file(folder / "path.toml", text);
    PluginRegistry registry = path_registry();
    return read_path(folder / "path.toml", {overrides, {}}, registry);
}

/// A path that was made, with all that its record refers to.
struct DrivenPath {
    PathDescription description;
    std::unique_ptr<Material> material;
    std::unique_ptr<Retention> curve;
    PathRecord record;

    explicit DrivenPath(const std::string& text)
        : description(read_path_text(text)),
          material(path_registry().make_material(description.model.name, description.model.parameters)),
          curve(description.retention
                    ? path_registry().make_retention(description.retention->name, description.retention->parameters)
                    : nullptr),
          record(drive_path(description, *material, curve.get()))
    {
    }

    const std::vector<PathRow>& rows() const { return record.rows; }
    const MaterialPoint& start() const { return record.rows.front().point; }
    const MaterialPoint& end() const { return record.rows.back().point; }
};

} // namespace periporo::test
