// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// A disk that is full, or a process without file handles: one message with the system's reason, and a run that goes on
// when there is room again.
//
// The fault is for the files of the writers and the mark of the folder. The suite tries a spread of the calls at which
// the disk is full; PERIPORO_LONG_TESTS=1 tries all of them.
#include "faults/faulty_run.hpp"

#include <cerrno>
#include <cstring>

using namespace periporo::test;

namespace {

std::size_t count(const std::string& text, const std::string& part)
{
    std::size_t number = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
        ++number;
    return number;
}

/// @param below as in FaultyRun
void check_fault(int error, const std::string& below, long tries)
{
    FaultyRun whole;
    whole.below = below;
    REQUIRE(whole.run_with_fault("none", 0).status == 0);
    const auto expected = whole.results();
    long refused = 0;
    for (long call = 1; call <= whole.calls(); call += every_call() ? 1 : 1 + whole.calls() / tries) {
        CAPTURE(call);
        FaultyRun full;
        full.below = below;
        const ProgramResult failed = full.run_with_fault("fail", call, "", error);
        INFO(failed.error);
        if (failed.status == 0) // what is left needs no room: deleting what only a resumed run would need
            continue;
        ++refused;
        CHECK((failed.status == 1 || failed.status == 2)); // 2 when the folder cannot even be marked; never a signal
        CAPTURE(std::string(std::strerror(error)));
        CHECK(count(failed.error, std::strerror(error)) >= 1);
        CHECK(count(failed.error, "periporo: ") == 1);
        CHECK(failed.error.find("HDF5") == std::string::npos);
        const ProgramResult rest = full.go_on();
        INFO(rest.error);
        REQUIRE(rest.status == 0);
        check_same_results(full.results(), expected);
    }
    MESSAGE(refused, " runs failed, ", below, ": ", std::string(std::strerror(error)));
}

} // namespace

TEST_CASE("a full disk is told with the reason of the system, and the run goes on when there is room")
{
    for (const char* below : {"/results", "/history.csv", "/periporo.run", "/checkpoint"})
        check_fault(ENOSPC, below, 6);
}

TEST_CASE("a quota, a disk that becomes read-only, and one that fails are told with the reason of the system too")
{
    for (const int error : {EDQUOT, EROFS, EIO})
        check_fault(error, "/results", 3);
}

TEST_CASE("a process without file handles says so, and its run can be resumed")
{
    check_fault(EMFILE, "/results", 6);
}

TEST_CASE(
    "a disk that is full before the first checkpoint by the clock costs no more than the stage: --resume ends the run")
{
    for (const char* below : {"/results", "/history.csv", "/checkpoint", "/summary"}) {
        CAPTURE(below);
        FaultyRun whole;
        whole.below = below;
        whole.checkpoint_every = "60 s";
        REQUIRE(whole.run_with_fault("none", 0).status == 0);
        const auto expected = whole.results();
        long refused = 0;
        for (long call = 1; call <= whole.calls(); call += every_call() ? 1 : 1 + whole.calls() / 10) {
            CAPTURE(call);
            FaultyRun full;
            full.below = below;
            full.checkpoint_every = "60 s";
            const ProgramResult failed = full.run_with_fault("fail", call, "", ENOSPC);
            INFO(failed.error);
            if (failed.status == 0)
                continue;
            ++refused;
            const ProgramResult rest = full.run("--resume");
            INFO(rest.error);
            REQUIRE(rest.status == 0);
            check_same_results(full.results(), expected);
        }
        MESSAGE(refused, " runs failed, ", std::string(below));
    }
}

TEST_CASE("a run whose results have no room to be merged has all of its steps in its checkpoint")
{
    FaultyRun whole;
    whole.below = "/results.h5";
    whole.checkpoint_every = "60 s";
    REQUIRE(whole.run_with_fault("none", 0).status == 0);
    FaultyRun full;
    full.below = whole.below;
    full.checkpoint_every = whole.checkpoint_every;
    ProgramResult failed;
    for (long call = whole.calls(); failed.status != 1 && call > 0; --call) { // the last call that needs room
        if (std::filesystem::exists(full.out()))
            std::filesystem::remove_all(full.out());
        failed = full.run_with_fault("fail", call, "", ENOSPC);
    }
    CAPTURE(failed.error);
    CHECK(failed.error.find("step 20") != std::string::npos);
    CHECK(failed.error.find("No space left on device; make room there") != std::string::npos);
    CHECK(failed.error.find("--resume goes on from the checkpoint of step 20") != std::string::npos);
    REQUIRE(full.run("--resume").status == 0);
    CHECK(ProgramFolder::read(full.out() / "run.log").find("resumed behind stage 'fall' at step 20") !=
          std::string::npos);
    check_same_results(full.results(), whole.results());
}

TEST_CASE("a failed write names the file, the step and the way on")
{
    FaultyRun whole;
    whole.below = "/results";
    REQUIRE(whole.run_with_fault("none", 0).status == 0);
    FaultyRun full;
    full.below = "/results";
    const ProgramResult failed = full.run_with_fault("fail", whole.calls() / 2, "", ENOSPC);
    CHECK(failed.status == 1);
    const std::string out = full.out().string();
    for (const char* part : {"stage 'fall', step ", out.c_str(), "No space left on device; make room there",
                             "--resume goes on from the checkpoint of step "}) {
        INFO(failed.error);
        CAPTURE(part);
        CHECK(failed.error.find(part) != std::string::npos);
    }
}
