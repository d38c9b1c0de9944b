// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Errors of a case that are found while its model is built.
#pragma once

#include "case/description.hpp"
#include "case/reader.hpp"

#include <functional>
#include <string>

namespace periporo {

/// An error with the place of a part of the case.
/// @param key   of CaseDescription::places, "body.soil.geometry"; the nearest part around it that has a place counts
/// @param hint  a way out; may be empty
CaseError refusal(const CaseDescription& description, const std::string& key, const std::string& message,
                  const std::string& hint = {});

/// Does what belongs to a part of the case; what goes wrong there is an error of the case. Only a lack of memory is
/// not.
/// @throws CaseError, PluginError, std::bad_alloc
void refuse_failures(const CaseDescription& description, const std::string& key, const std::function<void()>& work);

/// A warning with the place of a part of the case: "case.toml:12:1: warning: ...".
std::string suspicion(const CaseDescription& description, const std::string& key, const std::string& message);

} // namespace periporo
