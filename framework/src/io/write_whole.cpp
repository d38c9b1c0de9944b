// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
#include "io/write_whole.hpp"

#include <fmt/format.h>

#include <fstream>
#include <stdexcept>

namespace periporo {

void write_whole(const std::filesystem::path& file, std::string_view text)
{
    const std::filesystem::path aside = file.string() + ".part";
    std::ofstream stream(aside, std::ios::binary);
    stream << text;
    stream.close();
    if (!stream)
        throw std::runtime_error(fmt::format("cannot write {}", aside.string()));
    std::filesystem::rename(aside, file);
}

} // namespace periporo
