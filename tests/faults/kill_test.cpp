// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// A run that is killed at any call on its folder, and resumed, ends at the same bits as one that never was.
//
// The suite tries a spread of the calls. All of them, which takes some minutes:
//     PERIPORO_LONG_TESTS=1 build/release/bin/faults --source-file='*/kill_test.cpp'
#include "faults/faulty_run.hpp"

#include <set>

using namespace periporo::test;

namespace {

constexpr long tries = 20; ///< of a spread

/// Numbers from 1 to `calls`: all of them, or some with the first and the last ones.
std::set<long> chosen(long calls)
{
    std::set<long> numbers;
    for (long n = 1; n <= calls; ++n)
        if (every_call() || n <= 2 || n > calls - 2 || n % (1 + calls / tries) == 0)
            numbers.insert(n);
    return numbers;
}

} // namespace

TEST_CASE("a run that is killed at a call on its results, before it or in the middle of a write, ends at the same bits")
{
    const FaultyRun whole;
    REQUIRE(whole.run_with_fault("none", 0).status == 0);
    const auto expected = whole.results();
    REQUIRE(whole.calls() > 500); // twenty checkpoints with all that is written before each
    CHECK(expected.contains("/snapshots/000005/position"));
    long number = 0;
    for (const long call : chosen(whole.calls())) {
        const char* kind = ++number % 2 == 0 ? "half" : "kill";
        CAPTURE(call);
        CAPTURE(kind);
        const FaultyRun killed;
        CHECK(killed.run_with_fault(kind, call).status == 137); // by the signal
        const ProgramResult rest = killed.go_on();
        INFO(rest.error);
        REQUIRE(rest.status == 0);
        check_same_results(killed.results(), expected);
    }
    MESSAGE(number, " kills");
}

TEST_CASE(
    "a resumed run that is killed as well, while it cuts what is later than the checkpoint, ends at the same bits")
{
    const FaultyRun whole;
    REQUIRE(whole.run_with_fault("none", 0).status == 0);
    const auto expected = whole.results();
    const long middle = whole.calls() / 2 + 7;
    const long of_resume = 60; // what a resumed run does before its first step, and a little more
    for (const long call : chosen(of_resume)) {
        CAPTURE(call);
        const FaultyRun killed;
        CHECK(killed.run_with_fault("kill", middle).status == 137);
        CHECK(killed.run_with_fault("kill", call, "--resume").status == 137);
        const ProgramResult rest = killed.go_on();
        INFO(rest.error);
        REQUIRE(rest.status == 0);
        check_same_results(killed.results(), expected);
    }
    MESSAGE(std::to_string(2 * chosen(of_resume).size()), " kills");
}
