// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// What tells two cases apart.
#pragma once

#include <string>
#include <vector>

namespace periporo {

/// Do two resolved cases give the same results? The title, [run] checkpoint_every and [plugins] paths have no influence
/// on them: plugins are compared by their content (InputHashes).
bool give_same_results(const std::string& there, const std::string& here);

/// The keys without influence whose values differ, as of case_difference().
std::vector<std::string> differences_without_influence(const std::string& there, const std::string& here);

/// The first key with influence of two resolved cases whose values differ, with both values: "contact.0.friction is 0.5
/// there and 0.4 here". A key that only one of them has is said to be only there or only here. When no such key differs
/// it is the first one without influence.
std::string case_difference(const std::string& there, const std::string& here);

} // namespace periporo
