// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
#include "scheduler/progress.hpp"

#include <cmath>
#include <cstdio>
#include <fmt/format.h>
#include <unistd.h>

namespace periporo {
namespace {

constexpr std::chrono::milliseconds on_terminal{250};
constexpr std::chrono::milliseconds in_log{10000};

} // namespace

Progress::Progress(bool quiet) : quiet_(quiet), terminal_(isatty(STDERR_FILENO) != 0), last_(Clock::now()) {}

Progress::~Progress()
{
    clear();
}

void Progress::update(const std::function<std::string()>& text)
{
    if (quiet_)
        return;
    const Clock::time_point now = Clock::now();
    if (now - last_ < (terminal_ ? on_terminal : in_log))
        return;
    show(text());
}

void Progress::announce(const std::function<std::string()>& text)
{
    if (terminal_ && !quiet_)
        show(text());
    else
        update(text);
}

void Progress::show(const std::string& text)
{
    last_ = Clock::now();
    // A terminal that is gone is no error.
    std::fputs((terminal_ ? "\r\033[K" + text : text + '\n').c_str(), stderr);
    std::fflush(stderr);
    shown_ = terminal_;
}

void Progress::clear()
{
    if (shown_)
        std::fputs("\r\033[K", stderr);
    shown_ = false;
}

std::string duration_text(double seconds)
{
    if (!std::isfinite(seconds) || seconds < 0.0)
        return "?";
    const auto whole = static_cast<long>(std::lround(seconds));
    if (whole >= 3600)
        return fmt::format("{} h {} min", whole / 3600, whole % 3600 / 60);
    if (whole >= 120)
        return fmt::format("{} min {} s", whole / 60, whole % 60);
    return fmt::format("{} s", whole);
}

} // namespace periporo
