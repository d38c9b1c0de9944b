// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Shows long work: a line that renews itself on a terminal, a plain line every few seconds without one.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <string>

namespace periporo {

class Progress {
public:
    /// @param quiet shows nothing
    explicit Progress(bool quiet);
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    /// Shows the line that `text` makes, if it is time for one.
    void update(const std::function<std::string()>& text);
    /// Shows the line on a terminal at once: what begins may take long and has no parts to tell of. Elsewhere it is
    /// one line like others.
    void announce(const std::function<std::string()>& text);
    /// Ends the renewing line, so that other text can follow.
    void clear();

private:
    void show(const std::string& text);
    using Clock = std::chrono::steady_clock;
    bool quiet_;
    bool terminal_;
    bool shown_ = false;
    Clock::time_point last_;
};

/// "1 h 12 min", "45 s".
std::string duration_text(double seconds);

} // namespace periporo
