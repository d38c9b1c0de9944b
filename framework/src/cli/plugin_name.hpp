// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Names of new plugins: what is allowed, and the forms that a name takes in a source.
#pragma once

#include <string>
#include <string_view>

namespace periporo::cli {

/// Why a new plugin cannot be called so, as a part of a sentence; empty when it can. A name is written as
/// lower_snake_case and is not a keyword of C++.
std::string name_objection(std::string_view name);

/// my_clay as the name of a class, "MyClay".
std::string class_name(std::string_view name);

/// The text of a template about my_plugin (class MyPlugin, in words "my plugin") as a text about the plugin `name`.
std::string renamed(std::string_view text, std::string_view name);

} // namespace periporo::cli
