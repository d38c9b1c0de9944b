// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Plugins of every kind that only take parameters, and cases that use them.
#pragma once

#include "case/reader.hpp"
#include "support/case_text.hpp"
#include "support/temporary_folder.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace periporo::test {

/// Refuses an inner radius that is not the smaller one: a check between parameters, made by the constructor.
class Shell : public Geometry {
public:
    Shell() = default;
    explicit Shell(const Parameters& parameters)
    {
        if (parameters.real("inner") >= parameters.real("outer"))
            throw std::runtime_error("the inner radius must be smaller than the outer one");
    }
    static std::vector<Parameter> parameters()
    {
        return {Parameter::real("inner", dimension::length, "Inner radius").above(0.0),
                Parameter::real("outer", dimension::length, "Outer radius").above(0.0),
                Parameter::real_list("centre", dimension::length, 3, "Centre").by_default({0.0, 0.0, 0.0})};
    }
    bool contains(const Vector3&) const override { return false; }
    Bounds bounds() const override { return {}; }
    double volume() const override { return 0.0; }
    PointCloud fill(double) const override { return {}; }
};

/// A geometry made of others, and one from a file.
class Union : public Shell {
public:
    explicit Union(const Parameters&) {}
    static std::vector<Parameter> parameters() { return {Parameter::geometries("of", "What is joined")}; }
};
class Scan : public Shell {
public:
    explicit Scan(const Parameters&) {}
    static std::vector<Parameter> parameters() { return {Parameter::file("file", "Points of the scan")}; }
};

/// Has a parameter of every type.
class Clay : public Material {
public:
    explicit Clay(const Parameters&) {}
    static std::vector<Parameter> parameters()
    {
        return {Parameter::real("stiffness", dimension::pressure, "Young's modulus").above(0.0).formerly("modulus"),
                Parameter::integer("exponent", "Exponent of the law").at_least(1).at_most(9).by_default(2),
                Parameter::boolean("associated", "Associated flow").by_default(true),
                Parameter::text("surface", "Yield surface").one_of({"ellipse", "cone"}).by_default("ellipse"),
                Parameter::real_list("path", dimension::none, 0, "Points of a curve").at_least(0.0).optional(),
                Parameter::text_list("notes", 0, "Where the parameters come from").optional()};
    }
    const std::vector<StateVariable>& state_variables() const override { return states_; }
    double bulk_modulus() const override { return 1.0; }
    double shear_modulus() const override { return 1.0; }
    MaterialStatus update(const MaterialBatch&) const override { return {}; }
    void initialize(const MaterialBatch&, double) const override {}

private:
    std::vector<StateVariable> states_;
};

class Wall : public Contact {
public:
    explicit Wall(const Parameters&) {}
    static std::vector<Parameter> parameters()
    {
        return {Parameter::real("friction", dimension::none, "Coefficient of friction").at_least(0.0)};
    }
    void scale(const ContactScale&) override {}
    double cutoff() const override { return 0.0; }
    double friction() const override { return 0.0; }
    void evaluate(std::span<const ContactPair>, std::span<ContactResponse>) const override {}
};

class Writer : public OutputWriter {
public:
    explicit Writer(const Parameters&) {}
    static std::vector<Parameter> parameters() { return {}; }
    void begin(const RunDescription&) override {}
    void snapshot(const Snapshot&) override {}
    void history(std::uint64_t, std::span<const double>) override {}
    void finish(bool) override {}
};

class Curve : public Retention {
public:
    explicit Curve(const Parameters&) {}
    static std::vector<Parameter> parameters()
    {
        return {Parameter::real("air_entry", dimension::pressure, "Suction at which air enters").above(0.0)};
    }
    double saturation(double, double) const override { return 0.5; }
};

/// A registry that knows test_shell, test_union, test_scan, test_clay, test_wall, test_curve and test_writer.
inline PluginRegistry test_registry()
{
    static const PluginDescriptor shell = describe_plugin<PluginKind::geometry, Shell>("test_shell", "A shell");
    static const PluginDescriptor joint = describe_plugin<PluginKind::geometry, Union>("test_union", "A union");
    static const PluginDescriptor scan = describe_plugin<PluginKind::geometry, Scan>("test_scan", "A scan");
    static const PluginDescriptor clay = describe_plugin<PluginKind::material, Clay>("test_clay", "A clay");
    static const PluginDescriptor wall = describe_plugin<PluginKind::contact, Wall>("test_wall", "A wall");
    static const PluginDescriptor curve = describe_plugin<PluginKind::retention, Curve>("test_curve", "A curve");
    static const PluginDescriptor writer = describe_plugin<PluginKind::output, Writer>("test_writer", "A writer");
    PluginRegistry registry;
    registry.add(shell, "/test/shell.so");
    registry.add(joint, "/test/union.so");
    registry.add(scan, "/test/scan.so");
    registry.add(clay, "/test/clay.so");
    registry.add(wall, "/test/wall.so");
    registry.add(curve, "/test/curve.so");
    registry.add(writer, "/test/writer.so");
    return registry;
}

/// A sound case with nothing that could be left out.
inline const std::string minimal_case = R"(title = "minimal"
[discretization]
spacing = "5 mm"
[material.soil]
model = "test_clay"
grain_density = 2200
porosity = 0.2
stiffness = "25 MPa"
[body.heap]
geometry = { generator = "test_shell", inner = "1 cm", outer = "2 cm" }
material = "soil"
[[stage]]
name = "collapse"
type = "dynamic"
duration = "0.5 s"
)";

/// A sound case that gives every key that a case can have, no value equal to its default.
inline const std::string full_case = R"(title = "full"
gravity = ["1 m/s2", 0, "-9.8 m/s2"]
[plugins]
paths = ["more_plugins"]
[discretization]
spacing = "5 mm"
horizon = 2.1
refresh = "every_step"
skin = 0.25
[operator]
force_state = "bond_projection"
influence = "linear"
[time]
safety = 0.5
step = "2 us"
[material.soil]
model = "test_clay"
grain_density = "2.2 g/cm3"
porosity = 0.2
stiffness = "25 MPa"
exponent = 3
associated = false
surface = "cone"
path = [0.5, "50 %"]
notes = ["a \"quoted\" note", "a path C:\\soil"]
[material.air]
model = "test_clay"
grain_density = 1.5
porosity = 0
stiffness = 1e5
retention = { curve = "test_curve", air_entry = "3 kPa" }
[body.heap]
geometry = { generator = "test_shell", inner = "1 cm", outer = "2 cm", centre = [0, 0, "1 m"] }
material = "soil"
water = { type = "uniform", suction = "20 kPa", saturation = 0.3 }
velocity = [0, "1 mm/s", 0]
angular_velocity = [0, 0, "2 rad/s"]
strain_rate = ["1 s^-1", "2 s^-1", "-3 s^-1", "4 s^-1", 0, "5 ms^-1"]
initial_stress = { type = "geostatic", K0 = 0.53, overconsolidation_ratio = 1.25 }
fill = { type = "jittered", align = "axes", amplitude = 0.1, seed = 5 }
[body.bubble]
geometry = { generator = "test_shell", inner = "1 mm", outer = "2 mm" }
material = "air"
fill = { type = "relaxed", seed = 6, iterations = 7 }
[geometry.core]
generator = "test_shell"
inner = "3 mm"
outer = "4 mm"
[geometry.rim]
generator = "test_union"
of = ["core"]
[obstacle.plate]
geometry = { generator = "test_union", of = ["rim"] }
velocity = [0, 0, "3 mm/s"]
moves_in = ["collapse"]
stages = ["settle", "collapse"]
[[boundary]]
type = "symmetry"
plane = "y = -100 mm"
[[boundary]]
type = "periodic"
plane = "x = 0"
period = "1 m"
[[boundary]]
type = "fixed"
plane = "z = 1 mm"
body = "heap"
[[boundary]]
type = "roller"
layer = ["z = 2 mm", "z = 3 mm"]
direction = [0, 3, 4]
[[boundary]]
type = "moving"
within = "rim"
velocity = ["1 mm/s", "2 mm/s", 0]
stages = ["settle"]
[[contact]]
law = "test_wall"
between = ["heap", "bubble"]
friction = 0.3
[[contact]]
law = "test_wall"
between = ["bubble", "heap"]
surface = "heap"
friction = 0.4
[[contact]]
law = "test_wall"
between = ["heap", "plate"]
friction = 0.5
[[stage]]
name = "settle"
type = "quasi_static"
rollers = ["x = 100 mm", "z = 1e-1 m"]
damping = 0.7
maximum_steps = 100
response = "full"
until = { residual = 1e-4 }
[[stage]]
name = "collapse"
type = "dynamic"
duration = "0.5 s"
until = { rest_speed = "5 mm/s" }
[[stage.water]]
body = "bubble"
type = "uniform"
suction = "5 kPa"
over = "10 ms"
[[output]]
writer = "test_writer"
every = "10 ms"
times = [0, "1 ms"]
[comparison]
law = "axisymmetric_column"
radius = "10 cm"
height = "12 cm"
[run]
checkpoint_every = "5 min"
history_every = "2 ms"
energy_error_limit = 0.02
)";

inline CaseDescription read_text(const std::string& text, const std::vector<std::string>& overrides = {})
{
    const TemporaryFolder folder;
    write_file(folder / "case.toml", text);
    PluginRegistry registry = test_registry();
    return read_case(folder / "case.toml", {overrides, {}}, registry);
}

/// All errors of a case; none when it is sound.
inline std::vector<CaseDiagnostic> errors_of(const std::string& text, const std::vector<std::string>& overrides = {})
{
    try {
        read_text(text, overrides);
    } catch (const CaseError& error) {
        return error.diagnostics();
    }
    return {};
}

/// The one error that a case has.
inline CaseDiagnostic error_of(const std::string& text, const std::vector<std::string>& overrides = {})
{
    const std::vector<CaseDiagnostic> errors = errors_of(text, overrides);
    if (errors.size() != 1) {
        std::string found = "one error expected, found " + std::to_string(errors.size());
        for (const CaseDiagnostic& error : errors)
            found += "\n  " + error.message;
        throw std::logic_error(found);
    }
    return errors.front();
}

inline LineColumn place_of(const CaseDiagnostic& error)
{
    return {error.line, error.column};
}

} // namespace periporo::test

namespace doctest {
template <>
struct StringMaker<periporo::test::LineColumn> {
    static String convert(const periporo::test::LineColumn& place)
    {
        return fmt::format("{}:{}", place.line, place.column).c_str();
    }
};
} // namespace doctest
