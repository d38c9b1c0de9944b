// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The critical-state law along paths whose end or whole course is known exactly (physics: modified Cam-clay).
#include "critical_state_soil.hpp"

#include <doctest/doctest.h>

using namespace periporo;
using namespace periporo::test;

namespace {

// Strain that shears by `shear` in all without change of volume, along the xx axis (compression).
Strain undrained_triaxial(double shear)
{
    return {-shear, 0.5 * shear, 0.5 * shear, 0.0, 0.0, 0.0};
}

bool same_state(const MaterialPoint& one, const MaterialPoint& other)
{
    for (std::size_t s = 0; s < Soil::state_count; ++s)
        if (one.state(s) != other.state(s))
            return false;
    return true;
}

// Root of 0 = (p - p0)/K + (lambda - kappa) ln(2 p/pc0), where all volume change is elastic against plastic.
double undrained_critical_pressure(double p0, double pc0)
{
    double p = 0.5 * pc0;
    for (int iteration = 0; iteration < 100; ++iteration)
        p -= ((p - p0) / bulk_modulus + plastic_index * std::log(2.0 * p / pc0)) /
             (1.0 / bulk_modulus + plastic_index / p);
    return p;
}

} // namespace

TEST_CASE("isotropic virgin loading follows (p - p0)/K + (lambda - kappa) ln(p/pc0) = eps_v")
{
    const double p0 = 500.0, pc0 = 800.0;
    const SoilMaterial material(soil_parameters());
    MaterialPoint point = isotropic_point(material, p0, pc0);
    for (int n = 1; n <= 200; ++n) {
        step(point, Strain::isotropic(-1e-3 / 3.0));
        const double p = mean_pressure(point.stress());
        const double strain = (p - p0) / bulk_modulus + plastic_index * std::log(p / pc0);
        // backward Euler keeps p = pc and the split of the strain exactly, so only round-off and the return's
        // tolerance of 1e-12 gather
        CHECK(strain == doctest::Approx(1e-3 * n).epsilon(1e-11).scale(0.0));
    }
    CHECK(mean_pressure(point.stress()) > 10.0 * pc0); // it was a long way
}

TEST_CASE("the drained triaxial path keeps q = 3 (p - p0), pc = p + q2/(M2 p) and the volume of both")
{
    const double p0 = 1000.0, pc0 = 1250.0;
    const SoilMaterial material(soil_parameters());
    MaterialPoint point = isotropic_point(material, p0, pc0);
    int yielding = 0;
    for (int n = 0; n < 400; ++n) {
        step_triaxial(point, -5e-4);
        const double p = mean_pressure(point.stress());
        const double q = deviator_stress(point.stress());
        // the driver leaves 1e-7 Pa at each of 400 steps
        CHECK(std::abs(q - 3.0 * (p - p0)) <= 1e-4);
        if (point.state(Soil::shear_strain) == 0.0)
            continue;
        ++yielding;
        const double pc = preconsolidation(point);
        CHECK(pc == doctest::Approx(p + q * q / (critical_slope * critical_slope * p)).epsilon(1e-11));
        CHECK(-trace(point.strain()) ==
              doctest::Approx((p - p0) / bulk_modulus + plastic_index * std::log(pc / pc0)).epsilon(1e-9).scale(0.0));
    }
    CHECK(yielding > 390);
}

TEST_CASE("drained shear ends in the critical state q = M p, pc = 2 p, at p = 3 p0/(3 - M)")
{
    const double p0 = 1000.0;
    for (const double overconsolidation : {1.1, 8.0}) { // contracting and dilating
        CAPTURE(overconsolidation);
        const SoilMaterial material(soil_parameters());
        MaterialPoint point = isotropic_point(material, p0, overconsolidation * p0);
        for (int n = 0; n < 3000; ++n)
            step_triaxial(point, -1e-3);
        const double p = mean_pressure(point.stress());
        // the distance dies out as exp(-(3 - M)/3 M/(lambda - kappa) eps_s) = exp(-8.7 x 3) = 5e-12; 3000 steps of a
        // driver that leaves 1e-7 Pa of 1000 Pa
        CHECK(p == doctest::Approx(3.0 * p0 / (3.0 - critical_slope)).epsilon(1e-6));
        CHECK(deviator_stress(point.stress()) == doctest::Approx(critical_slope * p).epsilon(1e-6));
        CHECK(preconsolidation(point) == doctest::Approx(2.0 * p).epsilon(1e-6));
    }
}

TEST_CASE("undrained shear ends in the critical state at the pressure its constant volume allows")
{
    for (const double p0 : {1000.0, 300.0})
        for (const double overconsolidation : {1.1, 8.0}) {
            CAPTURE(p0);
            CAPTURE(overconsolidation);
            const double pc0 = overconsolidation * p0;
            const SoilMaterial material(soil_parameters());
            MaterialPoint point = isotropic_point(material, p0, pc0);
            for (int n = 0; n < 5000; ++n)
                step(point, undrained_triaxial(2e-4));
            const double p = mean_pressure(point.stress());
            // p is elastic against the hardening: the distance dies out with the elastic strain p/K = 1e-4
            CHECK(p == doctest::Approx(undrained_critical_pressure(p0, pc0)).epsilon(1e-9));
            CHECK(deviator_stress(point.stress()) == doctest::Approx(critical_slope * p).epsilon(1e-9));
            CHECK(preconsolidation(point) == doctest::Approx(2.0 * p).epsilon(1e-9));
        }
}

TEST_CASE("simple shear at constant volume reaches the same critical state as triaxial compression")
{
    const SoilMaterial material(soil_parameters());
    MaterialPoint point = isotropic_point(material, 1000.0, 3000.0);
    for (int n = 0; n < 5000; ++n)
        step(point, Strain{0.0, 0.0, 0.0, 2e-4, 0.0, 0.0});
    const double p = undrained_critical_pressure(1000.0, 3000.0);
    CHECK(mean_pressure(point.stress()) == doctest::Approx(p).epsilon(1e-9));
    CHECK(point.stress().xy == doctest::Approx(critical_slope * p / std::sqrt(3.0)).epsilon(1e-9));
}

TEST_CASE("unloading and reloading inside the surface closes, with the state untouched")
{
    const SoilMaterial material(soil_parameters());
    MaterialPoint point = isotropic_point(material, 1000.0, 1100.0);
    for (int n = 0; n < 20; ++n)
        step(point, undrained_triaxial(1e-4));
    const MaterialPoint loaded = point;
    const Strain unloading = undrained_triaxial(-1e-5) + Strain::isotropic(2e-6);
    step(point, unloading);
    CHECK(deviator_stress(point.stress()) < 0.7 * deviator_stress(loaded.stress()));
    CHECK(same_state(point, loaded));
    // back to just short of the surface: exactly on it, round-off decides what yields
    step(point, unloading * -0.999);
    CHECK(same_state(point, loaded));
    const Stress left = elastic_stress(loaded.stress(), unloading * 0.001, bulk_modulus, shear_modulus);
    CHECK(norm(point.stress() - left) <= 1e-12 * norm(loaded.stress()));
}

TEST_CASE("the paper's viscosity of 1000 Pa3 s is indistinguishable from none")
{
    const SoilMaterial inviscid_soil(soil_parameters());
    MaterialPoint inviscid = isotropic_point(inviscid_soil, 1000.0, 1250.0);
    const SoilMaterial viscous_soil(soil_parameters({{"viscosity", 1000.0}}));
    MaterialPoint viscous = isotropic_point(viscous_soil, 1000.0, 1250.0);
    for (int n = 0; n < 100; ++n) {
        step(inviscid, undrained_triaxial(1e-4), 1e-4);
        step(viscous, undrained_triaxial(1e-4), 1e-4);
    }
    // f = eta dl/dt with dl = M2 deps_s/(2 q) = 6e-8 1/Pa and dt = 1e-4 s: 0.6 Pa2, against a^2 = 2.5e5 Pa2
    CHECK(norm(viscous.stress() - inviscid.stress()) <= 1e-5 * norm(inviscid.stress()));
    CHECK(norm(viscous.stress() - inviscid.stress()) > 0.0);
}
