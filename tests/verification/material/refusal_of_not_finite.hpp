// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Checks that a law refuses, with a reason, what is not a finite number.
#pragma once

#include "periporo/material_law.hpp"

#include <doctest/doctest.h>

#include <array>
#include <limits>
#include <string>
#include <vector>

namespace periporo::test {

/// Puts each of NaN, infinity and what would overflow into each number of an input; all must fail with the reason.
template <class Law>
void check_refuses_what_is_not_finite(const Law& law, const LawInput<double, Law::state_count>& good)
{
    REQUIRE_FALSE(law.update(good).failed);
    const double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
    for (const double bad : {nan, infinity, -infinity, 1e150}) {
        CAPTURE(bad);
        std::vector<LawInput<double, Law::state_count>> inputs(12 + Law::state_count + 1, good);
        for (int c = 0; c < 6; ++c) {
            const auto component = [&](SymmetricTensor<double>& a) -> double& {
                return *std::array{&a.xx, &a.yy, &a.zz, &a.xy, &a.yz, &a.xz}[static_cast<std::size_t>(c)];
            };
            component(inputs[static_cast<std::size_t>(c)].stress) = bad;
            component(inputs[static_cast<std::size_t>(6 + c)].strain_increment) = bad;
        }
        for (std::size_t s = 0; s < Law::state_count; ++s)
            inputs[12 + s].state[s] = bad;
        inputs.back().time_step = bad;
        for (std::size_t n = 0; n < inputs.size(); ++n) {
            CAPTURE(n);
            const auto after = law.update(inputs[n]);
            CHECK(after.failed);
            REQUIRE(after.reason != nullptr);
            CHECK(std::string(after.reason).find("not a finite number") != std::string::npos);
        }
    }
}

} // namespace periporo::test
