// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Runs a small case in a folder of its own and reads what it leaves.
#pragma once

#include "case/reader.hpp"
#include "scheduler/run.hpp"
#include "support/case_text.hpp"
#include "support/plugins.hpp"
#include "support/temporary_folder.hpp"

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace periporo::test {

struct SmallRun {
    std::string failure; ///< empty when the run is complete
    nlohmann::json summary;
    std::map<std::string, std::vector<double>> history; ///< by name of the column

    double largest(const std::string& column) const
    {
        double value = 0.0;
        for (const double v : history.at(column))
            value = std::max(value, std::abs(v));
        return value;
    }
    double energy(const std::string& name) const { return summary.at("energy").at(name).get<double>(); }
};

inline std::map<std::string, std::vector<double>> columns_of(std::istream& text)
{
    std::map<std::string, std::vector<double>> columns;
    std::vector<std::string> names;
    for (std::string line; std::getline(text, line);) {
        if (line.empty() || line.front() == '#')
            continue;
        std::istringstream cells(line);
        std::size_t column = 0;
        const bool head = names.empty();
        for (std::string cell; std::getline(cells, cell, ','); ++column)
            if (head)
                names.push_back(cell.substr(0, cell.find(' ')));
            else
                columns[names.at(column)].push_back(std::stod(cell));
    }
    return columns;
}

inline SmallRun run_text(const std::string& text)
{
    const TemporaryFolder folder;
    write_file(folder / "case.toml", text);
    PluginRegistry registry;
    const CaseDescription description =
        read_case(folder / "case.toml", {{}, {PERIPORO_BUILD_DIR "/lib/periporo"}}, registry);
    SmallRun result;
    RunOptions options;
    options.directory = folder / "out";
    options.threads = 1;
    options.quiet = true;
    try {
        run_case(description, registry, options);
    } catch (const std::exception& error) {
        result.failure = error.what();
    }
    if (std::filesystem::exists(options.directory)) // not that of a case that was refused
        std::ifstream(options.directory / "summary.json") >> result.summary;
    std::ifstream history(options.directory / "history.csv");
    result.history = columns_of(history);
    return result;
}

} // namespace periporo::test
