// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Paths of the paper's silt whose end or whole course is known exactly (modified Cam-clay), from file to rows.
#include "support/paths.hpp"

using namespace periporo;
using namespace periporo::test;

namespace {

constexpr double bulk_modulus = 25e6;
constexpr double plastic_index = 0.12 - 0.04; // lambda - kappa
constexpr double slope = 1.1;                 // M
constexpr double p0 = 100e3;

std::string soil_path(double overconsolidation, const std::string& stage)
{
    return silt + "[initial]\npressure = \"100 kPa\"\noverconsolidation_ratio = " + std::to_string(overconsolidation) +
           "\n[[stage]]\nduration = 1\n" + stage;
}

double preconsolidation(const MaterialPoint& point)
{
    return std::exp(point.state(ViscoplasticCriticalState::log_preconsolidation));
}

/// Root of 0 = (p - p0)/K + (lambda - kappa) ln(2 p/pc0), where all volume change is elastic against plastic.
double undrained_critical_pressure(double pc0)
{
    double p = 0.5 * pc0;
    for (int iteration = 0; iteration < 100; ++iteration)
        p -= ((p - p0) / bulk_modulus + plastic_index * std::log(2.0 * p / pc0)) /
             (1.0 / bulk_modulus + plastic_index / p);
    return p;
}

} // namespace

TEST_CASE("isotropic loading to a pressure follows the virgin line, and the loop inside the surface leaves no trace")
{
    const DrivenPath path(
        soil_path(1.25, "type = \"isotropic\"\npressure = \"400 kPa\"\n"
                        "[[stage]]\nduration = 1\ntype = \"isotropic\"\npressure = \"50 kPa\"\ncycles = 1"));
    const MaterialPoint& loaded = path.rows()[100].point;
    for (const PathRow& row : path.rows()) {
        const double p = mean_pressure(row.point.stress());
        if (row.stage != 1 || p <= 1.25 * p0)
            continue;
        // the stress is met to a billionth in each step
        CHECK(-trace(row.point.strain()) ==
              doctest::Approx((p - p0) / bulk_modulus + plastic_index * std::log(p / (1.25 * p0)))
                  .epsilon(1e-7)
                  .scale(0.0));
    }
    CHECK(mean_pressure(path.rows()[200].point.stress()) == doctest::Approx(50e3).epsilon(1e-8));
    CHECK(preconsolidation(path.end()) == doctest::Approx(400e3).epsilon(1e-7));
    CHECK(trace(path.end().strain()) == doctest::Approx(trace(loaded.strain())).epsilon(1e-6).scale(0.0));
}

TEST_CASE("the drained triaxial path keeps q = 3 (p - p0) and ends in the critical state q = M p, p = 3 p0/(3 - M)")
{
    for (const double overconsolidation : {1.25, 8.0}) {
        CAPTURE(overconsolidation);
        const DrivenPath path(
            soil_path(overconsolidation, "type = \"triaxial_drained\"\naxial_compression = 2.5\nsteps = 2500"));
        for (const PathRow& row : path.rows()) {
            const double p = mean_pressure(row.point.stress());
            const double q = deviator_stress(row.point.stress());
            CHECK(std::abs(q - 3.0 * (p - p0)) <= 1e-8 * (p + q));
        }
        const double p = mean_pressure(path.end().stress());
        // the distance dies out as exp(-(3 - M)/3 M/(lambda - kappa) eps_s) = exp(-8.7 x 2.5) = 4e-10
        CHECK(p == doctest::Approx(3.0 * p0 / (3.0 - slope)).epsilon(1e-7));
        CHECK(deviator_stress(path.end().stress()) == doctest::Approx(slope * p).epsilon(1e-7));
        CHECK(preconsolidation(path.end()) == doctest::Approx(2.0 * p).epsilon(1e-7));
    }
}

TEST_CASE("undrained triaxial and constant-height simple shear end at the critical pressure of their volume")
{
    for (const double overconsolidation : {1.25, 8.0})
        for (const std::string stage :
             {"type = \"triaxial_undrained\"\naxial_compression = 0.5\nsteps = 2500",
              "type = \"simple_shear\"\nvertical = \"constant_height\"\nshear_strain = 1.0\nsteps = 2500"}) {
            CAPTURE(stage);
            const DrivenPath path(soil_path(overconsolidation, stage));
            const double p = mean_pressure(path.end().stress());
            // p is elastic against the hardening: the distance dies out with the elastic strain p/K < 0.02, 25 times
            CHECK(p == doctest::Approx(undrained_critical_pressure(overconsolidation * p0)).epsilon(1e-9));
            CHECK(deviator_stress(path.end().stress()) == doctest::Approx(slope * p).epsilon(1e-9));
        }
}

TEST_CASE("at the critical state a viscous soil is overstressed by eta dl/dt, at each rate its own")
{
    std::string text = silt;
    text = with(text, "viscosity = 0", "viscosity = 1e18") +
           "[initial]\npressure = \"100 kPa\"\noverconsolidation_ratio = 1.25\n";
    for (const char* rate : {"1e-5", "1e-4", "1e-5"})
        text += std::string("[[stage]]\ntype = \"triaxial_undrained\"\naxial_compression = 0.2\nsteps = 1000\n") +
                "strain_rate = " + rate + "\n";
    const DrivenPath path(text);
    std::vector<double> strengths;
    for (const std::size_t row : {1000U, 2000U, 3000U}) {
        const double rate = row == 2000U ? 1e-4 : 1e-5;
        const SymmetricTensor<double> stress = path.rows()[row].point.stress();
        const double p = mean_pressure(stress);
        const double q = deviator_stress(stress);
        const double yield = q * q / (slope * slope) + p * (p - preconsolidation(path.rows()[row].point));
        // flow is of shear alone, deps_s = dl 2 q/M2; what is left of the approach to it is below 1e-6 after 0.2
        CHECK(yield == doctest::Approx(1e18 * rate * slope * slope / (2.0 * q)).epsilon(1e-5));
        strengths.push_back(q);
    }
    CHECK(strengths[1] > 1.05 * strengths[0]);
    CHECK(strengths[2] == doctest::Approx(strengths[0]).epsilon(1e-5));
}

TEST_CASE("a step that is too large for the law is made in halves, and in no more than it may")
{
    const std::string impatient = "title = \"in small steps\"\n[material.m]\nmodel = \"impatient\"\n[initial]\n"
                                  "pressure = \"10 kPa\"\n[[stage]]\ntype = \"oedometric\"\nduration = 1\n"
                                  "axial_compression = 0.03\nsteps = 10\n"; // a step is 3 times what the law takes
    const DrivenPath made(impatient + "halvings = 2");
    CHECK_FALSE(made.record.failure);
    CHECK(made.end().stress().zz == doctest::Approx(-10e3 - 0.03 * (2e6 + 4.0 / 3.0 * 1.2e6)).epsilon(1e-12));

    const DrivenPath refused(impatient + "halvings = 1");
    REQUIRE(refused.record.failure);
    CHECK(refused.record.failure->step == 1);
    CHECK(refused.record.failure->reason == "the strain increment is too large");
    CHECK(refused.rows().size() == 1);
}

TEST_CASE("a stress that the soil cannot bear fails and leaves the rows before it")
{
    // the critical state is at q = 3 M p0/(3 - M) = 173.7 kPa
    const DrivenPath path(soil_path(1.25, "type = \"triaxial_drained\"\ndeviator_stress = \"200 kPa\"\nsteps = 20"));
    REQUIRE(path.record.failure);
    CHECK(path.record.failure->step == 18); // steps of 10 kPa
    CHECK(deviator_stress(path.end().stress()) == doctest::Approx(170e3).epsilon(1e-8));
}

TEST_CASE("given state variables replace those that follow from the overconsolidation ratio")
{
    const std::string text = soil_path(2.0, "type = \"isotropic\"\npressure = \"110 kPa\"");
    CHECK(preconsolidation(DrivenPath(text).start()) == doctest::Approx(2.0 * p0).epsilon(1e-12));
    const std::string given = with(text, "[[stage]]", "state = { log_preconsolidation_pressure = 12.5 }\n[[stage]]");
    CHECK(DrivenPath(given).start().state(ViscoplasticCriticalState::log_preconsolidation) == 12.5);
}
