// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// User routines that go wrong, libraries that do not load, and several threads at once.
#include "abaqus/material_of_library.hpp"
#include "abaqus/misbehaving_ways.h"

#include "periporo/kit/block.hpp"
#include "support/case_text.hpp"
#include "support/errors.hpp"
#include "support/temporary_folder.hpp"

#include <doctest/doctest.h>

#include <initializer_list>
#include <string>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>
#include <vector>

using namespace periporo;
using namespace periporo::test;

namespace {

using Tensor6 = SymmetricTensor<double>;

std::unique_ptr<Material> misbehaving(Way way, const char* interface = "umat")
{
    return material_of_library("misbehaving", interface,
                               {{"properties", std::vector<double>{static_cast<double>(way)}},
                                {"state_variables", std::int64_t{1}},
                                {"initial_state", std::vector<double>{10.0}}});
}

/// A block in which the routine goes wrong at bond 11 of 20.
kit::Block block_of(const Material& material)
{
    kit::BlockPoint point;
    point.old.state = {10.0};
    std::vector<kit::BlockPoint> points(20, point);
    points[11].strain_increment.xx = 0.02;
    return {material, points};
}

void check_failure(const Material& material, std::initializer_list<std::string> parts)
{
    const MaterialStatus status = block_of(material).update(1e-4);
    REQUIRE_FALSE(status.converged);
    CHECK(status.bond == 11);
    REQUIRE(status.reason != nullptr);
    check_mentions(status.reason, parts);
}

std::string refusal(const std::string& library, Values given = {})
{
    return message_of_error([&] { material_of_library(library, "umat", std::move(given)); });
}

/// The numbers of threads that two threads met in the routine of company.c.
std::pair<double, double> met_inside(const Material& one, const Material& other)
{
    const Material* const materials[2] = {&one, &other};
    double met[2] = {};
    std::vector<std::thread> threads;
    for (std::size_t n = 0; n < 2; ++n)
        threads.emplace_back([&, n] {
            MaterialPoint point(*materials[n]);
            if (point.step(Tensor6{}, 1e-4).converged)
                met[n] = point.state(0);
        });
    for (std::thread& thread : threads)
        thread.join();
    return {met[0], met[1]};
}

std::unique_ptr<Material> company(bool thread_safe, double wait)
{
    return material_of_library("company", "umat",
                               {{"properties", std::vector<double>{wait}},
                                {"state_variables", std::int64_t{1}},
                                {"thread_safe", thread_safe}});
}

} // namespace

TEST_CASE("a request for a smaller step is a failure of that bond, with what to do")
{
    check_failure(*misbehaving(smaller_step), {"umat_ of", "misbehaving.so", "smaller time step", "PNEWDT", "safety"});
}

TEST_CASE("XIT does not return to the routine, and is a failure of that bond")
{
    check_failure(*misbehaving(leave), {"umat_ of", "called XIT"});
}

TEST_CASE("a routine that called XIT can be called again")
{
    const auto material = misbehaving(leave);
    for (int n = 0; n < 3; ++n)
        check_failure(*material, {"called XIT"});
    MaterialPoint point(*material);
    REQUIRE(point.step(Tensor6{}, 1e-4).converged);
    CHECK(point.state(0) == 11.0);
}

TEST_CASE("XPLB_EXIT in a VUMAT is a failure that names a bond of its block")
{
    const auto material = misbehaving(leave, "vumat");
    const MaterialStatus status = block_of(*material).update(1e-4);
    REQUIRE_FALSE(status.converged);
    CHECK(status.bond == 0); // the first of the call
    check_mentions(status.reason, {"vumat_ of", "called XIT"});
}

TEST_CASE("an error that ends the analysis arrives with its text filled in")
{
    check_failure(*misbehaving(stop_with_error), {"level 7, strain 0.02 in clay: 5 % too much"});
}

TEST_CASE("an error that does not end the analysis is a failure of that bond too")
{
    check_failure(*misbehaving(report_error), {"reported the error", "level 8, strain 0.02 in clay"});
}

TEST_CASE("a warning is no failure")
{
    const auto material = misbehaving(warn);
    CHECK(block_of(*material).update(1e-4).converged);
}

TEST_CASE("a stress or a state variable that is not a finite number is a failure of that bond")
{
    check_failure(*misbehaving(not_finite), {"not a finite number"});
    check_failure(*misbehaving(not_finite, "vumat"), {"not a finite number"});
    check_failure(*misbehaving(state_not_finite), {"not a finite number"});
}

TEST_CASE("writing past the state variables is noticed")
{
    check_failure(*misbehaving(past_state), {"past the end", "state_variables is too small"});
    const auto material = misbehaving(past_state, "vumat");
    const MaterialStatus status = block_of(*material).update(1e-4);
    REQUIRE_FALSE(status.converged);
    check_mentions(status.reason, {"past the end", "state_variables is too small"});
}

TEST_CASE("STOP is a failure of that bond with its text, and the routine can be called again")
{
    const auto material = misbehaving(stop_statement);
    for (int n = 0; n < 3; ++n)
        check_failure(*material, {"umat_ of", "misbehaving.so", "STOP: bad props"});
    MaterialPoint point(*material);
    CHECK(point.step(Tensor6{}, 1e-4).converged);
}

TEST_CASE("a routine that calls exit(0) does not make the run a success")
{
    const auto material = misbehaving(end_program);
    kit::Block block = block_of(*material);
    const pid_t child = ::fork();
    if (child == 0) {
        block.update(1e-4);
        ::_exit(42); // the routine returned
    }
    int status = 0;
    REQUIRE(::waitpid(child, &status, 0) == child);
    REQUIRE(WIFEXITED(status));
    CHECK(WEXITSTATUS(status) == 1);
}

#ifdef PERIPORO_TEST_FORTRAN
TEST_CASE("what ends a program in Fortran is a failure that says what it was")
{
    const auto reason_of = [](double property) {
        const auto material =
            material_of_library("ending_fortran", "umat",
                                {{"properties", std::vector<double>{property}}, {"state_variables", std::int64_t{1}}});
        MaterialPoint point(*material);
        const MaterialStatus status = point.step(Tensor6{}, 1e-4);
        CHECK_FALSE(status.converged);
        return std::string(status.reason != nullptr ? status.reason : "");
    };
    check_mentions(reason_of(1.0), {"umat_ of", "STOP: bad props"});
    check_mentions(reason_of(2.0), {"STOP 7"});
    check_mentions(reason_of(3.0), {"ERROR STOP: worse props"});
    check_mentions(reason_of(4.0), {"CALL EXIT(3)"});
    check_mentions(reason_of(9.0), {"line", "'9'", "above upper bound of 3"}); // -fcheck=bounds
}

TEST_CASE("a VUMAT compiles with the include file of the page, and runs")
{
    const auto material =
        material_of_library("plain_vumat_fortran", "vumat",
                            {{"properties", std::vector<double>{1e6}}, {"state_variables", std::int64_t{0}}});
    MaterialPoint point(*material);
    Tensor6 strain;
    strain.yy = 1e-3;
    REQUIRE(point.step(strain, 1e-4).converged);
    CHECK(point.stress().yy == doctest::Approx(1e3));
    CHECK(point.stress().xx == 0.0);
}
#endif

TEST_CASE("the bond that fails keeps stress and state, those before it have the new ones")
{
    const auto material = misbehaving(leave);
    kit::Block block = block_of(*material);
    REQUIRE_FALSE(block.update(1e-4).converged);
    CHECK(block.values(10).state[0] == 11.0);
    CHECK(block.values(11).state[0] == 10.0);
}

TEST_CASE("a library that is not there is named, with the way it was looked for")
{
    check_mentions(refusal("", {{"library", std::string("/nowhere/libclay.so")}}),
                   {"/nowhere/libclay.so", "no such file"});
    check_mentions(refusal("", {{"library", std::string("libclay.so")}}), {"\"libclay.so\" cannot be loaded"});
}

TEST_CASE("a relative path is refused, for a material does not know the folder of its case")
{
    check_mentions(refusal("", {{"library", std::string("umats/libclay.so")}}),
                   {"umats/libclay.so", "relative", "absolute path", "LD_LIBRARY_PATH"});
}

TEST_CASE("a file that is no shared library is refused with the way to make one")
{
    const TemporaryFolder folder;
    write_file(folder / "clay.f", "      SUBROUTINE UMAT\n      END\n");
    check_mentions(refusal("", {{"library", (folder / "clay.f").string()}}), {"clay.f", "gfortran -shared -fPIC"});
}

TEST_CASE("a library without the routine is refused with the names that it has")
{
    check_mentions(refusal("plain_name"), {"no symbol umat_", "it exports umat", "symbol"});
    check_mentions(refusal("no_routine"), {"no symbol umat_", "SUBROUTINE UMAT", "nm -D"});
}

TEST_CASE("a routine under another symbol is found when it is named")
{
    const auto material =
        material_of_library("plain_name", "umat", {{"symbol", std::string("umat")}, {"properties", std::vector{5e6}}});
    MaterialPoint point(*material);
    REQUIRE(point.step(Tensor6{1e-3, 0.0, 0.0, 0.0, 0.0, 0.0}, 1e-4).converged);
    CHECK(point.stress().xx == 5e6 * 1e-3);
}

TEST_CASE("a routine of Abaqus that does not exist here is named, with those that do")
{
    check_mentions(refusal("unresolved"), {"getvrm_", "compile its source", "XIT", "SPRIND"});
}

TEST_CASE("lists that do not fit the number of state variables are refused")
{
    const Values two = {{"state_variables", std::int64_t{2}}};
    const auto with = [&](const char* name, ParameterValue value) {
        Values given = two;
        given[name] = std::move(value);
        return refusal("arguments", given);
    };
    check_mentions(with("initial_state", std::vector<double>{1.0}), {"initial_state has 1", "state_variables is 2"});
    check_mentions(with("state_names", std::vector<std::string>{"a", "b", "c"}), {"state_names has 3"});
    check_mentions(with("state_names", std::vector<std::string>{"a", "a"}), {"\"a\" twice"});
    check_mentions(with("states_of_point", std::vector<std::string>{"void"}), {"\"void\""});
}

TEST_CASE("calls into a library are made one after the other, from whichever material")
{
    const auto one = company(false, 0.05), other = company(false, 0.05);
    CHECK(met_inside(*one, *one) == std::pair(1.0, 1.0));
    CHECK(met_inside(*one, *other) == std::pair(1.0, 1.0));
}

TEST_CASE("a library that is safe for threads is called by several at once")
{
    const auto material = company(true, 60.0); // they meet long before
    CHECK(met_inside(*material, *material) == std::pair(2.0, 2.0));
}
