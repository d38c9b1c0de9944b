// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// What an error says.
#pragma once

#include <doctest/doctest.h>

#include <initializer_list>
#include <stdexcept>
#include <string>

namespace periporo::test {

/// The message of the std::runtime_error that the action must throw.
template <class Action>
std::string message_of_error(Action&& action)
{
    try {
        action();
    } catch (const std::runtime_error& error) {
        return error.what();
    }
    FAIL("no std::runtime_error was thrown");
    return {};
}

/// Checks that the text holds every part.
inline void check_mentions(const std::string& text, std::initializer_list<std::string> parts)
{
    for (const std::string& part : parts) {
        INFO("in: " << text);
        INFO("looked for: " << part);
        CHECK(text.find(part) != std::string::npos);
    }
}

} // namespace periporo::test
