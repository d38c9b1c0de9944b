// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The file of a path is read as strictly as a case.
#include "case/resolved.hpp"
#include "case/toml_source.hpp"
#include "drive/path_results.hpp"
#include "drive/path_schema.hpp"
#include "support/paths.hpp"

using namespace periporo;
using namespace periporo::test;

namespace {

const std::string sound = silt + R"([initial]
pressure = "100 kPa"
[[stage]]
name = "shear"
type = "triaxial_drained"
axial_compression = 0.1
strain_rate = "1e-3 s^-1"
)";

/// The one error of a path, which must stand where the only `part` of the text begins.
CaseDiagnostic error_at(const std::string& text, const std::string& part)
{
    try {
        read_path_text(text);
    } catch (const CaseError& error) {
        CAPTURE(std::string(error.what()));
        REQUIRE(error.diagnostics().size() == 1);
        const CaseDiagnostic& found = error.diagnostics().front();
        const LineColumn wanted = place_in(text, part);
        CHECK(found.line == wanted.line);
        CHECK(found.column == wanted.column);
        return found;
    }
    FAIL("the path was accepted");
    return {};
}

std::string with_stage(const std::string& stage)
{
    return silt + "[initial]\npressure = \"100 kPa\"\n[[stage]]\n" + stage + "\n";
}

} // namespace

TEST_CASE("a sound path is accepted, with the duration from the rate")
{
    const PathDescription path = read_path_text(sound);
    CHECK(path.material_name == "silt");
    CHECK(path.stages.at(0).duration == doctest::Approx(100.0));
    CHECK(path.stages.at(0).name == "shear");
}

TEST_CASE("the material section of a case is accepted as it stands")
{
    const PathDescription path =
        read_path_text(with(sound, "viscosity = 0", "viscosity = 0\ngrain_density = \"2200 kg/m3\"\nporosity = 0.2"));
    CHECK(path.porosity == 0.2);
    CHECK(path.grain_density == 2200.0);
}

TEST_CASE("overrides reach the material, the start and the stages by name")
{
    const PathDescription path =
        read_path_text(sound, {"material.silt.critical_state_slope=1.3",
                               "initial.state.log_preconsolidation_pressure=12", "stage.shear.axial_compression=0.2"});
    CHECK(path.model.parameters.real("critical_state_slope") == 1.3);
    CHECK(path.state.at("log_preconsolidation_pressure") == 12.0);
    CHECK(path.stages.at(0).duration == doctest::Approx(200.0));
}

TEST_CASE("an unknown key is an error at its place with the nearest name")
{
    CHECK(contains(error_at(with(sound, "strain_rate", "strian_rate = 1\nstrain_rate"), "strian_rate").hint,
                   "did you mean 'strain_rate'?"));
    CHECK(contains(error_at(with(sound, "[initial]", "[initial]\nocr = 2"), "ocr").message, "unknown key 'ocr'"));
    CHECK(contains(error_at(with(sound, "title", "gravity = 0\ntitle"), "gravity").message, "unknown key 'gravity'"));
}

TEST_CASE("an unknown state variable is an error that names those of the law")
{
    const std::string text = with(sound, "[[stage]]", "state = { preconsolidation = 3 }\n[[stage]]");
    CHECK(contains(error_at(text, "preconsolidation = 3").hint, "log_preconsolidation_pressure"));
}

TEST_CASE("a unit of another dimension, a value out of range and a missing key are errors")
{
    error_at(with(sound, "\"100 kPa\"", "\"100 mm\""), "\"100 mm\"");
    error_at(with(sound, "pressure = \"100 kPa\"", "pressure = \"-1 kPa\""), "\"-1 kPa\"");
    CHECK(contains(
        error_at(with(sound, "type = \"triaxial_drained\"\n", "type = \"triaxial_undrained\"\nsteps = 0\n"), "0\naxial")
            .message,
        "'steps'"));
    CHECK(contains(error_at(with(sound, "bulk_modulus = \"25 MPa\"\n", ""), "[material.silt]").message,
                   "missing key 'bulk_modulus'"));
}

TEST_CASE("what the material refuses is an error of its section")
{
    CHECK(contains(error_at(with(sound, "swelling_index = 0.04", "swelling_index = 0.2"), "[material.silt]").hint,
                   "refuses its parameters"));
}

TEST_CASE("a second material is an error")
{
    error_at(with(sound, "[initial]",
                  "[material.rubber]\nmodel = \"hooke\"\nbulk_modulus = 1\n"
                  "shear_modulus = 1\n[initial]"),
             "[material.rubber]");
}

TEST_CASE("the stress at the start is given once")
{
    error_at(with(sound, "[[stage]]", "stress = [0, 0, 0, 0, 0, 0]\n[[stage]]"), "[0, 0, 0");
    error_at(with(sound, "pressure = \"100 kPa\"\n", ""), "[initial]");
}

TEST_CASE("a stage has one target and one duration")
{
    const std::string drained = "type = \"triaxial_drained\"\n";
    error_at(with_stage(drained + "duration = 1"), "[[stage]]");
    error_at(with_stage(drained + "axial_compression = 0.1"), "[[stage]]");
    error_at(with_stage(drained + "axial_compression = 0.1\ndeviator_stress = 7\nduration = 1"), "7");
    error_at(with_stage(drained + "axial_compression = 0.1\nduration = 1\nstrain_rate = 7"), "7");
    error_at(with_stage(drained + "deviator_stress = 1e3\nstrain_rate = 7"), "7");
    error_at(with_stage(drained + "axial_compression = 0\nstrain_rate = 7"), "7");
    error_at(with_stage("type = \"suction\"\nheld = \"total_stress\"\nduration = 1"), "[[stage]]");
    error_at(with_stage("type = \"true_triaxial\"\nduration = 1"), "[[stage]]");
}

TEST_CASE("a key of another kind of stage is an error that says whose it is")
{
    CHECK(contains(
        error_at(with_stage("type = \"isotropic\"\npressure = 1\nduration = 1\nshear_strain = 1"), "shear_strain").hint,
        "simple_shear"));
}

TEST_CASE("a component of a mixed stage is controlled once")
{
    const std::string mixed = "type = \"mixed\"\nduration = 1\n";
    error_at(with_stage(mixed + "stress = { xx = 5 }\nstrain = { xx = 7 }"), "7");
    error_at(with_stage(mixed + "stress = { xx = 5 }\nheld_stress = [\"xx\"]"), "[\"xx\"]");
    error_at(with_stage(mixed + "held_stress = [\"xx\", \"xx\"]"), "[\"xx\", ");
}

TEST_CASE("two-way cycles need cycles, and cannot be of water")
{
    error_at(with_stage("type = \"isotropic\"\npressure = 1\nduration = 1\ntwo_way = true"), "true");
    error_at(with_stage("type = \"suction\"\nheld = \"total_stress\"\nduration = 1\nsuction = 5\nsaturation = 1\n"
                        "cycles = 1\ntwo_way = true"),
             "true");
}

TEST_CASE("a retention curve says the saturation, and needs the porosity")
{
    const std::string curve = "retention = { curve = \"hyperbola\", half = \"1 kPa\" }\n";
    const std::string wet = with(sound, "viscosity = 0\n", "viscosity = 0\nporosity = 0.4\n" + curve);
    const DrivenPath path(with(wet, "[[stage]]", "suction = \"1 kPa\"\n[[stage]]"));
    CHECK(path.start().saturation() == doctest::Approx(0.6));
    const DrivenPath again(path.description.resolved);
    CHECK(path_table(again.description, again.record) == path_table(path.description, path.record));
    error_at(with(sound, "viscosity = 0\n", "viscosity = 0\n" + curve), "{ curve");
    error_at(with(wet, "[[stage]]", "suction = \"1 kPa\"\nsaturation = 0.77\n[[stage]]"), "0.77");
    error_at(wet + "[[stage]]\ntype = \"suction\"\nheld = \"total_stress\"\nsaturation = 0.77\nsuction = 2\n"
                   "duration = 1\n",
             "0.77");
}

TEST_CASE("suction without water is an error, at the start and later")
{
    error_at(with(sound, "[[stage]]", "suction = \"1 kPa\"\n[[stage]]"), "\"1 kPa\"");
    error_at(with_stage("type = \"suction\"\nheld = \"total_stress\"\nduration = 1\nsuction = \"1 kPa\""), "\"1 kPa\"");
}

TEST_CASE("the resolved path reads back to itself and leads to the same end, to the last bit")
{
    const std::string text = with(sound, "viscosity = 0", "viscosity = 0\nporosity = 0.4");
    const DrivenPath first(text);
    const DrivenPath again(first.description.resolved);
    CHECK(again.description.resolved == first.description.resolved);
    CHECK(path_table(again.description, again.record) == path_table(first.description, first.record));
}

TEST_CASE("the table has a named column with its unit for everything, and a row for the start and each step")
{
    const DrivenPath path(with(sound, "viscosity = 0", "viscosity = 0\nporosity = 0.5"));
    const std::string table = path_table(path.description, path.record);
    const std::string header = table.substr(0, table.find('\n'));
    for (const char* name :
         {"step,stage,time [s],", "stress_xx [Pa]", "strain_xz [-]", "p [Pa]", "q [Pa]", "volumetric_compression [-]",
          "equivalent_shear_strain [-]", "specific_volume [-]", "void_ratio [-]", "suction [Pa]", "saturation [-]",
          "log_preconsolidation_pressure [ln Pa]"})
        CHECK(contains(header, name));
    CHECK(std::count(table.begin(), table.end(), '\n') == 1 + 1 + 100);
}

TEST_CASE("the specific volume is 1/(1 - phi0) exp(tr eps), and unknown without a porosity")
{
    const std::string stage = "[initial]\npressure = 0\n[[stage]]\nduration = 1\ntype = \"isotropic\"\n"
                              "volumetric_compression = 0.1";
    const DrivenPath path(with(rubber, "bulk_modulus", "porosity = 0.5\nbulk_modulus") + stage);
    CHECK(specific_volume(path.description, path.start()).value() == 2.0);
    CHECK(specific_volume(path.description, path.end()).value() == doctest::Approx(2.0 * std::exp(-0.1)));
    const DrivenPath unknown(rubber + stage);
    CHECK_FALSE(specific_volume(unknown.description, unknown.end()));
}

TEST_CASE("more increments than can be kept are an error, in one stage or by their cycles")
{
    const std::string stage = "type = \"triaxial_drained\"\naxial_compression = 0.1\nstrain_rate = \"1e-3 s^-1\"\n";
    const CaseDiagnostic many = error_at(with_stage(stage + "steps = 9000000000000000000"), "9000000000000000000");
    CHECK(many.message == "'steps' must be 1 .. 1e+06, not 9e+18");
    const CaseDiagnostic cycles = error_at(with_stage(stage + "steps = 100000\ncycles = 60"), "100000");
    CHECK(cycles.message == "up to this stage there are 1.2e+07 increments, more than 1e+07");
}
