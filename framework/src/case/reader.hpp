// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Reads a case file strictly: every error of the file at once, each with its place and a way out.
#pragma once

#include "case/description.hpp"
#include "plugins/registry.hpp"

#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

namespace periporo {

/// One thing that is wrong in a case: what, where, and what would be right.
struct CaseDiagnostic {
    std::filesystem::path file; ///< empty for an override of the command line
    std::size_t line = 0;       ///< from 1; 0 when the place is the file as a whole
    std::size_t column = 0;
    std::string message;       ///< one sentence
    std::string hint;          ///< nearest name, allowed names with units, or a way out; may be empty
    std::string override_text; ///< the override at fault, "body.soil.material=sand"; empty for a place in a file
};

/// All errors of a case. what() is the full text for the user: file:line:column, message, the line, a caret, the hint.
class CaseError : public std::runtime_error {
public:
    CaseError(std::vector<CaseDiagnostic> diagnostics, const std::string& text)
        : std::runtime_error(text), diagnostics_(std::move(diagnostics))
    {
    }
    const std::vector<CaseDiagnostic>& diagnostics() const { return diagnostics_; }

private:
    std::vector<CaseDiagnostic> diagnostics_;
};

struct CaseOptions {
    std::vector<std::string> overrides;                      ///< "body.column.material=sand", TOML values or bare text
    std::vector<std::filesystem::path> command_line_plugins; ///< of --plugin-path
};

/// Reads, checks and resolves a case. Loads the plugins it needs into `registry` (its own `[plugins] paths` included).
/// @throws CaseError with every error found.
CaseDescription read_case(const std::filesystem::path& file, const CaseOptions& options, PluginRegistry& registry);

} // namespace periporo
