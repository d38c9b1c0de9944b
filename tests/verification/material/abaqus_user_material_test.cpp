// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Laws in shared libraries with the interface of UMAT or VUMAT: what they are given, and what comes back.
#include "abaqus/material_of_library.hpp"

#include "periporo/kit/block.hpp"
#include "periporo/kit/random.hpp"
#include "periporo/material_kit.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <vector>

using namespace periporo;
using namespace periporo::test;

namespace {

using Tensor6 = SymmetricTensor<double>;

// C11 C22 C33 C12 C13 C23 G12 G13 G23 [Pa], all different
const std::vector<double> orthotropic = {50e6, 40e6, 30e6, 11e6, 12e6, 13e6, 7e6, 8e6, 9e6};

/// Hooke's law of an orthotropic body.
Tensor6 orthotropic_stress(const Tensor6& e)
{
    const std::vector<double>& c = orthotropic;
    return {c[0] * e.xx + c[3] * e.yy + c[4] * e.zz,
            c[3] * e.xx + c[1] * e.yy + c[5] * e.zz,
            c[4] * e.xx + c[5] * e.yy + c[2] * e.zz,
            2.0 * c[6] * e.xy,
            2.0 * c[8] * e.yz,
            2.0 * c[7] * e.xz};
}

const double bulk = 20e6, shear = 10e6, yield = 30e3, hardening = 2e6;

Values hardening_plasticity()
{
    return {{"properties", std::vector<double>{bulk, shear, yield, hardening}},
            {"state_variables", std::int64_t{2}},
            {"state_names", std::vector<std::string>{"plastic_strain", "plastic_steps"}}};
}

/// Largest difference between the components of two tensors.
double difference(const Tensor6& a, const Tensor6& b)
{
    return norm(a - b);
}

/// What the routine of arguments.c was given, number by number.
std::vector<double> arguments_given(const std::string& interface, std::size_t count, Values given = {})
{
    given.merge(Values{{"state_variables", static_cast<std::int64_t>(count)},
                       {"properties", std::vector<double>{2.5, 3.5}},
                       {"name", std::string("SAND")},
                       {"stress_unit", 1e3}});
    const auto material = material_of_library("arguments", interface, given);
    MaterialPoint point(*material);
    point.set_water(20e3, 0.4);
    const MaterialStatus status = point.step(Tensor6{}, 1e-3);
    INFO((status.converged ? "" : status.reason));
    REQUIRE(status.converged);
    std::vector<double> numbers;
    for (std::size_t s = 0; s < count; ++s)
        numbers.push_back(point.state(s));
    return numbers;
}

} // namespace

TEST_CASE("each component of strain meets its own stiffness, in its place and with its factor of shear")
{
    for (const std::string interface : {"umat", "vumat"}) {
        CAPTURE(interface);
        const auto material = material_of_library("orthotropic", interface, {{"properties", orthotropic}});
        const Tensor6 start{-1e3, -2e3, -3e3, 100.0, 200.0, 300.0};
        for (double Tensor6::*component :
             {&Tensor6::xx, &Tensor6::yy, &Tensor6::zz, &Tensor6::xy, &Tensor6::yz, &Tensor6::xz}) {
            MaterialPoint point(*material, start);
            Tensor6 strain;
            strain.*component = 1e-3;
            REQUIRE(point.step(strain, 1e-4).converged);
            // a few roundings of stresses of 50 kPa
            CHECK(difference(point.stress(), start + orthotropic_stress(strain)) <= 1e-10);
        }
    }
}

TEST_CASE("every bond of a block gets its own answer, and bonds that carry no stress keep what they hold")
{
    constexpr double untouched = -77.0;
    for (const std::string interface : {"umat", "vumat"}) {
        CAPTURE(interface);
        const auto material = material_of_library("orthotropic", interface, {{"properties", orthotropic}});
        kit::Random random;
        std::vector<kit::BlockPoint> points(300); // more than one call of a VUMAT takes
        for (std::size_t n = 0; n < points.size(); ++n) {
            points[n].active = n % 3 != 1;
            points[n].strain_increment = random.tensor(1e-3);
            points[n].old.stress = points[n].active ? random.tensor(1e4) : Tensor6::isotropic(untouched);
        }
        kit::Block block(*material, points);
        REQUIRE(block.update(1e-4).converged);
        for (std::size_t n = 0; n < points.size(); ++n) {
            const Tensor6 change = points[n].active ? orthotropic_stress(points[n].strain_increment) : Tensor6{};
            CHECK(difference(block.values(n).stress, points[n].old.stress + change) <= 1e-10);
        }
    }
}

TEST_CASE("every bond of a block has state variables of its own")
{
    const double strain = 2e-3; // beyond the largest yield stress of the block
    for (const std::string interface : {"umat", "vumat"}) {
        CAPTURE(interface);
        const auto material = material_of_library("hardening_plasticity", interface, hardening_plasticity());
        std::vector<kit::BlockPoint> points(300); // more than one call of a VUMAT takes
        for (std::size_t n = 0; n < points.size(); ++n) {
            points[n].strain_increment.xz = strain;
            points[n].old.state = {1e-6 * static_cast<double>(n), static_cast<double>(7 * n)};
        }
        kit::Block block(*material, points);
        REQUIRE(block.update(1e-4).converged);
        for (std::size_t n = 0; n < points.size(); ++n) {
            const std::vector<double> old = points[n].old.state;
            // sqrt(3) 2 G e - 3 G (e_p - old) = yield + H e_p
            const double plastic =
                (std::sqrt(3.0) * 2.0 * shear * strain - yield - hardening * old[0]) / (3.0 * shear + hardening);
            CHECK(block.values(n).state[0] == doctest::Approx(old[0] + plastic).epsilon(1e-14).scale(0.0));
            CHECK(block.values(n).state[1] == old[1] + 1.0);
        }
    }
}

TEST_CASE("plastic shear follows the closed form of linear hardening, and the state variables keep it")
{
    for (const std::string interface : {"umat", "vumat"}) {
        CAPTURE(interface);
        const auto material = material_of_library("hardening_plasticity", interface, hardening_plasticity());
        MaterialPoint point(*material);
        int plastic_steps = 0;
        for (int n = 1; n <= 200; ++n) {
            REQUIRE(point.step(Tensor6{0.0, 0.0, 0.0, 0.0, 5e-5, 0.0}, 1e-4).converged);
            // sqrt(3) tau = yield + H e_p with e_p = (gamma - tau/G)/sqrt(3), gamma = 2 e_yz
            const double gamma = 2.0 * 5e-5 * n;
            const double plastic =
                (yield + hardening * gamma / std::sqrt(3.0)) / (std::sqrt(3.0) + hardening / (std::sqrt(3.0) * shear));
            const double tau = std::min(shear * gamma, plastic);
            // 200 roundings of stresses of 20 kPa
            CHECK(point.stress().yz == doctest::Approx(tau).epsilon(1e-13));
            CHECK(point.state(0) ==
                  doctest::Approx((gamma - tau / shear) / std::sqrt(3.0)).epsilon(1e-12).scale(gamma));
            plastic_steps += plastic < shear * gamma ? 1 : 0;
            CHECK(point.state(1) == plastic_steps);
        }
        CHECK(point.state(0) > 5e-3); // the path went far into the plastic part
    }
}

TEST_CASE("uniaxial stress beyond yield has the tangent E H/(E + H)")
{
    const auto material = material_of_library("hardening_plasticity", "umat", hardening_plasticity());
    MaterialPoint point(*material);
    const MixedStep step{{false, true, true, false, false, false}, {1e-4, 0.0, 0.0, 0.0, 0.0, 0.0}, 1e-4};
    for (int n = 0; n < 50; ++n)
        REQUIRE(point.step(step).converged);
    const Tensor6 before = point.stress();
    REQUIRE(before.xx > yield);
    for (int n = 0; n < 10; ++n)
        REQUIRE(point.step(step).converged);
    const double young = 9.0 * bulk * shear / (3.0 * bulk + shear);
    // the lateral stresses are left within 1e-6 Pa, of a change by 2 kPa
    CHECK(point.stress().xx - before.xx ==
          doctest::Approx(1e-3 * young * hardening / (young + hardening)).epsilon(1e-8));
}

TEST_CASE("one law as UMAT and as VUMAT gives the same stresses and states along any path")
{
    const auto umat = material_of_library("hardening_plasticity", "umat", hardening_plasticity());
    const auto vumat = material_of_library("hardening_plasticity", "vumat", hardening_plasticity());
    kit::Random random;
    MaterialPoint one(*umat), other(*vumat);
    for (int n = 0; n < 200; ++n) {
        const Tensor6 strain = random.tensor(1e-3);
        REQUIRE(one.step(strain, 1e-4).converged);
        REQUIRE(other.step(strain, 1e-4).converged);
        // sums run in another order: roundings of stresses up to 1e6 Pa, 200 times
        CHECK(difference(one.stress(), other.stress()) <= 1e-7);
        CHECK(std::abs(one.state(0) - other.state(0)) <= 1e-7 / shear);
    }
}

TEST_CASE("the material test kit finds no fault in a sound routine")
{
    kit::Range metal;
    metal.tension_limit = std::numeric_limits<double>::infinity();
    metal.pressures = {1e3, 1e4}; // q = 0.3 p lies within the yield stress
    for (const std::string interface : {"umat", "vumat"}) {
        CAPTURE(interface);
        const auto material = material_of_library("hardening_plasticity", interface, hardening_plasticity());
        for (const std::string& fault : kit::check_material(*material, metal))
            FAIL_CHECK(fault);
    }
}

TEST_CASE("the elastic stage follows the moduli, leaves the state alone, and does not call the routine")
{
    Values given = hardening_plasticity();
    given["initial_state"] = std::vector<double>{0.25, 4.0};
    const auto material = material_of_library("hardening_plasticity", "umat", given);
    kit::BlockPoint point;
    point.old = {Tensor6::isotropic(-1e3), {0.25, 4.0}};
    point.strain_increment = {1e-2, 0.0, 0.0, 0.0, 2e-2, 0.0}; // far beyond yield
    kit::Block block(*material, {point});
    REQUIRE(block.update(1e-4, MaterialResponse::elastic).converged);
    const Tensor6 expected = Tensor6::isotropic(-1e3 + (bulk - 2.0 / 3.0 * shear) * 1e-2) +
                             Tensor6{2e7 * 1e-2, 0.0, 0.0, 0.0, 2e7 * 2e-2, 0.0}; // 2 G e
    CHECK(difference(block.values(0).stress, expected) <= 1e-9);                  // roundings of 400 kPa
    CHECK(block.values(0).state == std::vector<double>{0.25, 4.0});
}

TEST_CASE("state variables have names, begin at the given values, and may belong to the place")
{
    Values given = hardening_plasticity();
    given["initial_state"] = std::vector<double>{0.25, 4.0};
    given["states_of_point"] = std::vector<std::string>{"plastic_steps"};
    const auto material = material_of_library("hardening_plasticity", "umat", given);
    const std::vector<StateVariable>& variables = material->state_variables();
    REQUIRE(variables.size() == 2);
    CHECK(variables[0].name == "plastic_strain");
    CHECK(variables[0].initial == 0.25);
    CHECK_FALSE(variables[0].of_point);
    CHECK(variables[1].of_point);
    MaterialPoint point(*material);
    point.set_state(0, 9.0);
    point.initialize(1.25);
    CHECK(point.state(0) == 0.25);
    CHECK(point.state(1) == 4.0);
}

TEST_CASE("state variables without names are numbered")
{
    const auto material = material_of_library("arguments", "umat", {{"state_variables", std::int64_t{2}}});
    CHECK(material->state_variables()[0].name == "state_1");
    CHECK(material->state_variables()[1].name == "state_2");
    CHECK(material->state_variables()[1].unit == "-");
}

TEST_CASE("a UMAT is given sizes, time step, water in its own unit of stress, name and constants")
{
    const std::vector<double> a = arguments_given("umat", 40);
    const std::vector<double> sizes_and_properties(a.begin(), a.begin() + 7); // NDI NSHR NTENS NSTATV NPROPS PROPS
    CHECK(sizes_and_properties == std::vector<double>{3, 3, 6, 40, 2, 2.5, 3.5});
    CHECK(a[7] == 1e-3);                                                                    // DTIME
    CHECK(a[9] == 0.0);                                                                     // DTEMP
    CHECK(std::vector(a.begin() + 10, a.begin() + 14) == std::vector{20.0, 0.4, 0.0, 0.0}); // PREDEF, DPRED: kPa
    CHECK(std::vector(a.begin() + 15, a.begin() + 19) == std::vector{1.0, 1.0, 1.0, 2.0});  // NOEL NPT KSTEP KINC
    CHECK(a[19] >= 1.0);                                                                    // PNEWDT
    CHECK(std::vector(a.begin() + 20, a.begin() + 25) ==
          std::vector<double>{'S', 'N', 'D', ' ', 80}); // CMNAME(1:1), (3:3), (4:4), (80:80), its length
    CHECK(std::vector(a.begin() + 34, a.begin() + 38) == std::vector{1.0, 0.0, 1.0, 1.0}); // DROT
    CHECK(a[38] == 0.0);                                                                   // DDSDDE
    CHECK(a[39] == 0.0);                                                                   // SSE
}

TEST_CASE("a UMAT meets not-a-number where something is not known, and behind the end of its arrays")
{
    const std::vector<double> a = arguments_given("umat", 40);
    CHECK(a[8] == -999.0);                // TEMP
    CHECK(a[14] == -999.0);               // CELENT
    for (std::size_t n = 25; n < 34; ++n) // STRAN, TIME, COORDS, DFGRD0, DFGRD1
        CHECK(a[n] == -999.0);
    const std::vector<double> behind = arguments_given("umat", 42);
    CHECK(behind[40] == -999.0); // PROPS(NPROPS + 1)
    CHECK(behind[41] == -999.0); // STATEV(NSTATV + 1)
}

TEST_CASE("a UMAT can be given an undeformed body, a temperature and a length instead")
{
    const std::vector<double> a = arguments_given(
        "umat", 40,
        {{"unknown_quantities", std::string("undeformed")}, {"temperature", 293.0}, {"characteristic_length", 0.02}});
    CHECK(a[8] == 293.0);
    CHECK(a[14] == 0.02);
    // STRAN(1), STRAN(6), TIME never 0, COORDS(3), DFGRD0(1,1), (2,1), DFGRD1(3,3), (1,2)
    CHECK(std::vector(a.begin() + 25, a.begin() + 34) == std::vector{0.0, 0.0, 1e-3, 1e-3, 0.0, 1.0, 0.0, 1.0, 0.0});
}

TEST_CASE("a VUMAT is given sizes, time step, water and name, and not-a-number where something is not known")
{
    const std::vector<double> a = arguments_given("vumat", 28);
    CHECK(std::vector(a.begin(), a.begin() + 7) == std::vector<double>{1, 3, 3, 28, 2, 2, 0});
    CHECK(std::vector(a.begin() + 7, a.begin() + 10) == std::vector{-999.0, -999.0, 1e-3}); // stepTime totalTime dt
    CHECK(std::vector(a.begin() + 10, a.begin() + 13) == std::vector<double>{'S', ' ', 80});
    CHECK(std::vector(a.begin() + 13, a.begin() + 16) == std::vector{-999.0, -999.0, -999.0}); // length, temperatures
    CHECK(std::vector(a.begin() + 16, a.begin() + 19) == std::vector{20.0, 0.4, 0.4});
    CHECK(a[19] == -999.0);               // coordMp
    CHECK(a[20] == 0.0);                  // relSpinInc
    for (std::size_t n = 21; n < 26; ++n) // stretch, defgrad, density
        CHECK(a[n] == -999.0);
    CHECK(a[26] == 1.0); // noel as jblock(5)
    CHECK(a[27] == 3.5);
}

TEST_CASE("a VUMAT can be given an undeformed body instead, and is never told that time is zero")
{
    const std::vector<double> a = arguments_given("vumat", 28, {{"unknown_quantities", std::string("undeformed")}});
    CHECK(std::vector(a.begin() + 7, a.begin() + 10) == std::vector{1e-3, 1e-3, 1e-3});
    // stretch (3,3) and (1,2), defgrad (3,3) and (1,3)
    CHECK(std::vector(a.begin() + 21, a.begin() + 25) == std::vector{1.0, 0.0, 1.0, 0.0});
}

TEST_CASE("all bonds of a block that carry stress reach a VUMAT in one call")
{
    const auto material = material_of_library(
        "arguments", "vumat", {{"state_variables", std::int64_t{1}}, {"properties", std::vector<double>{0.0}}});
    kit::BlockPoint point;
    point.old.state = {0.0};
    std::vector<kit::BlockPoint> points(30, point);
    points[4].active = false;
    kit::Block block(*material, points);
    REQUIRE(block.update(1e-4).converged);
    CHECK(block.values(0).state[0] == 29.0);
    CHECK(block.values(29).state[0] == 29.0);
    CHECK(block.values(4).state[0] == 0.0);
}

TEST_CASE("a routine in kPa gives the stresses that it gives in Pa")
{
    std::vector<double> in_kilopascal = orthotropic;
    for (double& stiffness : in_kilopascal)
        stiffness *= 1e-3;
    for (const std::string interface : {"umat", "vumat"}) {
        CAPTURE(interface);
        const auto material =
            material_of_library("orthotropic", interface, {{"properties", in_kilopascal}, {"stress_unit", 1e3}});
        const Tensor6 start = Tensor6::isotropic(-1e4), strain{1e-3, -2e-3, 3e-3, 4e-3, -5e-3, 6e-3};
        MaterialPoint point(*material, start);
        REQUIRE(point.step(strain, 1e-4).converged);
        // roundings of stresses of 100 kPa
        CHECK(difference(point.stress(), start + orthotropic_stress(strain)) <= 1e-9);
    }
}

#ifdef PERIPORO_TEST_FORTRAN
TEST_CASE("a UMAT in fixed-form Fortran gives what the same law gives in C")
{
    const auto fortran = material_of_library("hardening_plasticity_fortran", "umat", hardening_plasticity());
    const auto c = material_of_library("hardening_plasticity", "umat", hardening_plasticity());
    kit::Random random;
    MaterialPoint one(*fortran), other(*c);
    for (int n = 0; n < 200; ++n) {
        const Tensor6 strain = random.tensor(1e-3);
        REQUIRE(one.step(strain, 1e-4).converged);
        REQUIRE(other.step(strain, 1e-4).converged);
        CHECK(difference(one.stress(), other.stress()) <= 1e-7); // 200 roundings of stresses up to 1e6 Pa
        CHECK(std::abs(one.state(0) - other.state(0)) <= 1e-7 / shear);
    }
}

TEST_CASE("an error that a UMAT in Fortran reports arrives with its text")
{
    Values given = hardening_plasticity();
    given["properties"] = std::vector<double>{bulk, shear, -5.0, hardening};
    given["name"] = std::string("SAND");
    const auto material = material_of_library("hardening_plasticity_fortran", "umat", given);
    const MaterialStatus status = MaterialPoint(*material).step(Tensor6{}, 1e-4);
    REQUIRE_FALSE(status.converged);
    CHECK(std::string(status.reason).find("Property 3 of SAND is -5") != std::string::npos);
}
#endif
