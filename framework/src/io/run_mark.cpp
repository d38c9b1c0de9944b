// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Reads the lines of a mark.
#include "io/run_mark.hpp"

#include <fmt/format.h>

#include <string_view>

namespace periporo {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view mark_begin = "A run of periporo writes into this folder; the last one was process ";

std::string first_line_in(const fs::path& file)
{
    std::ifstream mark = open_if_regular(file);
    std::string line;
    std::getline(mark, line);
    return line;
}

} // namespace

std::ifstream open_if_regular(const fs::path& file)
{
    std::error_code ignored;
    return fs::is_regular_file(fs::symlink_status(file, ignored)) ? std::ifstream(file) : std::ifstream();
}

std::string first_line_of_mark(std::uint64_t process)
{
    return fmt::format("{}{:20}\n", mark_begin, process);
}

bool is_run_mark(const fs::path& file)
{
    std::error_code ignored;
    const std::string line = first_line_in(file);
    return line.starts_with(mark_begin) || (fs::exists(file, ignored) && line.empty());
}

std::string process_of_mark(const fs::path& file)
{
    const std::string line = first_line_in(file);
    std::string process = line.size() > mark_begin.size() ? line.substr(mark_begin.size()) : "of unknown number";
    return process.erase(0, process.find_first_not_of(' '));
}

bool is_plain_name(const std::string& name)
{
    return !name.empty() && name.find('/') == std::string::npos && name != "." && name != ".." && name != run_mark &&
           name.find_first_of("\n\r") == std::string::npos;
}

std::set<std::string> names_in_mark(const fs::path& file)
{
    std::set<std::string> names;
    std::ifstream mark = open_if_regular(file);
    std::string line;
    std::getline(mark, line);
    while (std::getline(mark, line))
        if (is_plain_name(line) && !mark.eof())
            names.insert(line);
    return names;
}

} // namespace periporo
