// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// `periporo explain CASE`: the case in plain words.
#include "preview/explain.hpp"
#include "cli/commands.hpp"
#include "cli/places.hpp"
#include "cli/threads.hpp"
#include "preview/set_up_picture.hpp"

#include <fmt/core.h>

namespace periporo::cli {

ExitStatus explain(const ExplainArguments& arguments)
{
    use_threads(arguments.threads);
    if (!arguments.picture.empty())
        require_possible_file(arguments.picture);
    PluginRegistry registry;
    const CaseDescription description = read_case_loudly(arguments.the_case, registry);
    fmt::print("{}\n", explain_case(description, registry));
    if (!arguments.picture.empty()) {
        draw_case(description, registry, arguments.picture);
        fmt::print("  drawn in {}\n", arguments.picture);
    }
    return ExitStatus::done;
}

} // namespace periporo::cli
