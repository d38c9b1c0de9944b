// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The memory that is foretold is what a model takes.
#include "assembly/size_estimate.hpp"
#include "support/specimens.hpp"

#include <doctest/doctest.h>

using namespace periporo;

TEST_CASE("the memory of a point is foretold within a sixth, for every force state and horizon")
{
    // Model::memory counts vectors as they grew, in leaps of up to a half, so that no formula is much closer.
    for (const std::string& name : force_state_names())
        for (const double horizon : {2.015, 3.015, 5.015}) {
            CAPTURE(name);
            CAPTURE(horizon);
            Model model = specimens::from_positions(specimens::lattice(14, 14, 14, 0.01), 0.01, horizon);
            const auto force_state = make_force_state(name, Influence::by_name("linear", model.state.horizon));
            find_first_families(model, *force_state);
            force_state->evaluate(model, {StressUpdate::keep, MaterialResponse::full, 0.0});
            const auto points = static_cast<double>(model.size());
            const double bonds = static_cast<double>(model.neighbourhood.families.bonds()) / points;
            const double told = bytes_of_a_point(name, bonds, 0);
            CHECK(told == doctest::Approx(static_cast<double>(model.memory()) / points).epsilon(1.0 / 6.0));
        }
}

TEST_CASE("there is some memory, and its amounts are told in units that can be read")
{
    CHECK(available_memory() > 1e6);
    CHECK(memory_text(2.5e7) == "25 MB");
    CHECK(memory_text(1.5e9) == "1.5 GB");
}
