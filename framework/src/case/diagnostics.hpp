// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Collects what is wrong in a case, to be reported in one go.
#pragma once

#include "case/node.hpp"
#include "case/reader.hpp"

#include <string>
#include <vector>

namespace periporo {

/// "case.toml:12:1", "--set body.soil.material=sand", or "case" when the place is not known.
std::string place_text(const Place& place);

class Diagnostics {
public:
    /// @param message one sentence without a full stop.
    /// @param hint    a way out; its lines are shown indented. May be empty.
    void error(const Place& place, const std::string& message, const std::string& hint = {});
    /// Something that is accepted and worth a word: "file:line:column: warning: ...".
    void warning(const Place& place, const std::string& message);

    bool failed() const { return !errors_.empty(); }
    const std::vector<std::string>& warnings() const { return warnings_; }

    /// @throws CaseError with all errors so far, ordered by place, if there is one.
    void raise() const;

private:
    struct Error {
        Place place;
        std::string message;
        std::string hint;
    };
    static std::string rendered(const Error& error);

    std::vector<Error> errors_;
    std::vector<std::string> warnings_;
};

/// A hint made of the nearest name, if any is near, and all allowed ones.
std::string naming_hint(const std::string& wanted, const std::vector<std::string>& known, const std::string& what);

} // namespace periporo
