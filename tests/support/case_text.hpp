// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Small changes to a case text, and where in it something stands.
#pragma once

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

namespace periporo::test {

inline bool contains(const std::string& text, const std::string& part)
{
    return text.find(part) != std::string::npos;
}

/// Position of `part` in a text that must hold it exactly once.
inline std::size_t only_position(const std::string& text, const std::string& part)
{
    const std::size_t at = text.find(part);
    if (at == std::string::npos || text.find(part, at + 1) != std::string::npos)
        throw std::logic_error("the test expects \"" + part + "\" exactly once");
    return at;
}

/// `text` with the only `from` replaced.
inline std::string with(std::string text, const std::string& from, const std::string& to)
{
    return text.replace(only_position(text, from), from.size(), to);
}

struct LineColumn {
    std::size_t line = 0;
    std::size_t column = 0;
    friend bool operator==(const LineColumn&, const LineColumn&) = default;
};

/// Where the only `part` begins in an ASCII text.
inline LineColumn place_in(const std::string& text, const std::string& part)
{
    const std::size_t at = only_position(text, part);
    const auto lines = static_cast<std::size_t>(std::count(text.begin(), text.begin() + static_cast<long>(at), '\n'));
    const std::size_t line_begin = at == 0 ? 0 : text.rfind('\n', at - 1) + 1;
    return {lines + 1, at - line_begin + 1};
}

inline void write_file(const std::filesystem::path& file, const std::string& text)
{
    std::filesystem::create_directories(file.parent_path());
    std::ofstream(file, std::ios::binary) << text;
}

} // namespace periporo::test
