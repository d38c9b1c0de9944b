// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Errors and warnings of `periporo check` about small cases.
#pragma once

#include "cli/program.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <set>
#include <string>

namespace periporo::test {

inline const std::string box = "geometry = { generator = \"box\", size = [\"100 mm\", \"100 mm\", \"100 mm\"] }";

/// The error that both commands report on a case, whose place is where `at` begins.
inline std::string refusal(const std::string& text, const std::string& at)
{
    const ProgramFolder folder;
    folder.write("case.toml", text);
    const LineColumn place = place_in(text, at);
    std::string first;
    for (const std::string command : {"check case.toml", "run case.toml --quiet --out results"}) {
        const ProgramResult result = folder.run(command);
        CAPTURE(command);
        CAPTURE(result.error);
        CHECK(result.status == 2);
        CHECK(contains(result.error, fmt::format("case.toml:{}:{}: error: ", place.line, place.column)));
        CHECK(folder.entries() == std::set<std::string>{"case.toml"});
        if (first.empty())
            first = result.error;
        // The beginning says it; available memory, further on, changes from second to second.
        CHECK(contains(result.error, first.substr(first.find("error: "), 60)));
    }
    return first;
}

inline std::string refusal_of_change(const std::string& from, const std::string& to, const std::string& at)
{
    return refusal(with(small_case, from, to), at);
}

/// What `check` says of a case that it accepts.
inline std::string warning(const std::string& text)
{
    const ProgramFolder folder;
    folder.write("case.toml", text);
    const ProgramResult result = folder.run("check case.toml");
    CHECK(result.status == 0);
    CHECK(folder.entries() == std::set<std::string>{"case.toml"});
    return result.error;
}

/// The small case standing on its floor, so that nothing about it is suspicious.
inline const std::string standing = with(small_case, "\"-1 m\"", "0");

/// What `check` says of it with overrides.
inline std::string of_standing(const std::string& overrides)
{
    const ProgramFolder folder;
    folder.write("case.toml", standing);
    return folder.run("check case.toml " + overrides).error;
}

/// The small case with a plane or a pair in its middle, and another spacing.
inline std::string with_boundary(const std::string& boundary, const std::string& spacing)
{
    return with(standing, "\"25 mm\"", "\"" + spacing + "\"") + "[[boundary]]\n" + boundary + "\n";
}

inline std::string with_symmetry(const std::string& plane, const std::string& spacing)
{
    return with_boundary("type = \"symmetry\"\nplane = \"" + plane + "\"", spacing);
}

inline const std::string settle = "[[stage]]\nname = \"settle\"\ntype = \"quasi_static\"\n[[stage]]\nname = \"fall\"\n";

} // namespace periporo::test
