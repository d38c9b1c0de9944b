// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Finds keys of very many parts in a TOML text before it is parsed: what is nested as deeply overflows the stack.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

namespace periporo {

/// Most parts of a key, "a.b.c" has three. Cases have up to five. The parser itself refuses values nested deeper than
/// 256, so that no more levels than the product of both are ever built.
inline constexpr std::size_t most_key_parts = 32;

/// Where a key of more than `most_key_parts` parts stands.
struct DeepKey {
    std::size_t line = 1;
    std::size_t column = 1;
};

std::optional<DeepKey> find_deep_key(std::string_view text);

} // namespace periporo
