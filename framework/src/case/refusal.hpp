// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Errors of a case that are found while its model is built.
#pragma once

#include "case/description.hpp"
#include "case/reader.hpp"

#include <functional>
#include <string>
#include <vector>

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

/// Collects the errors of parts of a case that do not depend on each other, so that a user sees them all at once.
class Refusals {
public:
    explicit Refusals(const CaseDescription& description) : description_(description) {}

    /// Does what belongs to a part of the case and keeps what goes wrong there, as refuse_failures() words it; an error
    /// that says its place itself keeps it.
    /// @return whether nothing went wrong
    /// @throws std::bad_alloc
    bool attempt(const std::string& key, const std::function<void()>& work);
    /// @throws CaseError with all errors so far, in the order in which they were found, if there is one.
    void raise() const;

private:
    void keep(const CaseError& error);

    const CaseDescription& description_;
    std::vector<CaseDiagnostic> diagnostics_;
    std::string text_;
};

/// A warning with the place of a part of the case: "case.toml:12:1: warning: ...".
std::string suspicion(const CaseDescription& description, const std::string& key, const std::string& message);

} // namespace periporo
