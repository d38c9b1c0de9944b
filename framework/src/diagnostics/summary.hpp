// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// summary.json: the numbers of a run for people and tools.
#pragma once

#include "case/description.hpp"
#include "model/model.hpp"
#include "time/dynamics.hpp"

#include <filesystem>
#include <nlohmann/json_fwd.hpp>

namespace periporo {

/// What case, model and energy ledger say; how the run went is for the caller to add.
nlohmann::json summary_of(const CaseDescription& description, const Model& model, const Dynamics& dynamics);

/// Written aside and renamed: complete or absent.
/// @throws std::runtime_error
void write_json(const nlohmann::json& content, const std::filesystem::path& file);

} // namespace periporo
