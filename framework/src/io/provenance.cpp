// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
#include "io/provenance.hpp"

#include "periporo/plugin.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <omp.h>

namespace periporo {

std::map<std::string, std::string> provenance(const InputHashes& inputs, int threads)
{
    std::map<std::string, std::string> entries{
        {"periporo_version", PERIPORO_VERSION},
        {"compiler", "gcc " __VERSION__},
        {"abi", abi_fingerprint.data()},
        {"threads", std::to_string(threads > 0 ? threads : omp_get_max_threads())}};
    for (const auto& [role, input] : inputs.entries()) {
        std::string key = role;
        std::ranges::replace(key, ' ', '_');
        const bool is_code = role.starts_with("plugin ") || role.starts_with("library ") || role == "program";
        entries[is_code ? key : "file_" + key] = fmt::format("{} sha256 {}", input.file.string(), input.hash);
    }
    return entries;
}

} // namespace periporo
