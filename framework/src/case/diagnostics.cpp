// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Errors of a case as text: place, message, the line with a caret under the place, hint.
#include "case/diagnostics.hpp"

#include "sdk/nearest_name.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <tuple>
#include <utility>

namespace periporo {
namespace {

std::string location(const Place& place)
{
    if (!place.source)
        return "case";
    if (!place.source->override_text.empty())
        return "--set " + place.source->override_text;
    const std::string file = place.source->file.string();
    return place.line == 0 ? file : fmt::format("{}:{}:{}", file, place.line, place.column);
}

/// Spaces that put a caret under a column: tabs stay tabs, a character of several bytes counts once.
std::string padding(const std::string& line, std::size_t column)
{
    std::string text;
    std::size_t characters = 1;
    for (const char c : line) {
        if (characters >= column)
            break;
        const bool continues = (static_cast<unsigned char>(c) & 0xC0U) == 0x80U;
        if (continues)
            continue;
        text += c == '\t' ? '\t' : ' ';
        ++characters;
    }
    text.append(column > characters ? column - characters : 0, ' ');
    return text;
}

std::string source_excerpt(const Place& place)
{
    if (!place.source || place.line == 0 || place.line > place.source->lines.size())
        return {};
    const std::string& line = place.source->lines[place.line - 1];
    return fmt::format("{:>6} | {}\n{:>6} | {}^\n", place.line, line, "", padding(line, place.column));
}

std::string indented(const std::string& hint)
{
    std::string text;
    for (std::size_t begin = 0; begin < hint.size();) {
        const std::size_t end = std::min(hint.find('\n', begin), hint.size());
        text += fmt::format("  {}{}\n", begin == 0 ? "hint: " : "      ", hint.substr(begin, end - begin));
        begin = end + 1;
    }
    return text;
}

auto order(const Place& place)
{
    return std::make_tuple(place.source ? place.source->order : 0, place.line, place.column);
}

} // namespace

void Diagnostics::error(const Place& place, std::string message, std::string hint)
{
    errors_.push_back({place, std::move(message), std::move(hint)});
}

void Diagnostics::warning(const Place& place, const std::string& message)
{
    warnings_.push_back(fmt::format("{}: warning: {}", location(place), message));
}

std::string Diagnostics::rendered(const Error& error)
{
    return fmt::format("{}: error: {}\n{}{}", location(error.place), error.message, source_excerpt(error.place),
                       indented(error.hint));
}

void Diagnostics::raise() const
{
    if (errors_.empty())
        return;
    std::vector<Error> errors = errors_;
    std::stable_sort(errors.begin(), errors.end(),
                     [](const Error& a, const Error& b) { return order(a.place) < order(b.place); });
    std::vector<CaseDiagnostic> diagnostics;
    std::string text;
    for (const Error& error : errors) {
        const bool known = error.place.source != nullptr;
        const bool overridden = known && !error.place.source->override_text.empty();
        diagnostics.push_back({known ? error.place.source->file : std::filesystem::path(),
                               overridden ? 0 : error.place.line, overridden ? 0 : error.place.column, error.message,
                               error.hint, known ? error.place.source->override_text : std::string()});
        text += rendered(error);
    }
    throw CaseError(std::move(diagnostics), text);
}

std::string naming_hint(const std::string& wanted, const std::vector<std::string>& known, const std::string& what)
{
    if (known.empty())
        return fmt::format("there is no {}", what);
    const std::optional<std::string> nearest = nearest_name(wanted, known);
    return fmt::format("{}{}: {}", nearest ? fmt::format("did you mean '{}'?\n", *nearest) : "", what,
                       fmt::join(known, ", "));
}

} // namespace periporo
