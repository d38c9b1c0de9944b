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

constexpr std::size_t longest_word = 300;  ///< that a message repeats whole: a path, a name
constexpr std::size_t excerpt_width = 500; ///< characters of a line
constexpr std::size_t most_told = 100;     ///< errors; the others are counted

/// The text with very long words shortened.
std::string clipped(const std::string& text)
{
    std::string result;
    for (std::size_t begin = 0; begin < text.size();) {
        const std::size_t end = std::min(text.find_first_of(" \n", begin), text.size());
        if (end - begin <= longest_word)
            result += text.substr(begin, end - begin);
        else
            result += text.substr(begin, 60) + "..." + text.substr(end - 20, 20);
        if (end < text.size())
            result += text[end];
        begin = end + 1;
    }
    return result;
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
    if (line.size() > excerpt_width) // a caret far off the screen shows nothing
        return {};
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

std::string place_text(const Place& place)
{
    if (!place.source)
        return "case";
    if (!place.source->override_text.empty())
        return "--set " + clipped(place.source->override_text);
    const std::string file = place.source->file.string();
    return place.line == 0 ? file : fmt::format("{}:{}:{}", file, place.line, place.column);
}

void Diagnostics::error(const Place& place, const std::string& message, const std::string& hint)
{
    errors_.push_back({place, clipped(message), clipped(hint)});
}

void Diagnostics::warning(const Place& place, const std::string& message)
{
    warnings_.push_back(fmt::format("{}: warning: {}", place_text(place), message));
}

std::string Diagnostics::rendered(const Error& error)
{
    return fmt::format("{}: error: {}\n{}{}", place_text(error.place), error.message, source_excerpt(error.place),
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
        if (diagnostics.size() <= most_told)
            text += rendered(error);
    }
    if (errors.size() > most_told)
        text += fmt::format("and {} errors more\n", errors.size() - most_told);
    throw CaseError(std::move(diagnostics), text);
}

std::string naming_hint(const std::string& wanted, const std::vector<std::string>& known, const std::string& what)
{
    if (known.empty())
        return fmt::format("there are no {}", what);
    const std::optional<std::string> nearest = nearest_name(wanted, known);
    return fmt::format("{}{}: {}", nearest ? fmt::format("did you mean '{}'?\n", *nearest) : "", what,
                       fmt::join(known, ", "));
}

} // namespace periporo
