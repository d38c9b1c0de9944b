// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Compares resolved cases line by line: one key a line, in the order of the schema.
#include "io/case_difference.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <string_view>
#include <utility>
#include <vector>

namespace periporo {
namespace {

struct Entry {
    std::string key;
    std::string value;
};

std::string_view trimmed(std::string_view text)
{
    while (!text.empty() && text.front() == ' ')
        text.remove_prefix(1);
    while (!text.empty() && (text.back() == ' ' || text.back() == '\r'))
        text.remove_suffix(1);
    return text;
}

/// Text before a comment, which begins with # outside of quotes.
std::string_view without_comment(std::string_view text)
{
    bool quoted = false;
    for (std::size_t at = 0; at < text.size(); ++at) {
        if (quoted && text[at] == '\\')
            ++at;
        else if (text[at] == '"')
            quoted = !quoted;
        else if (text[at] == '#' && !quoted)
            return text.substr(0, at);
    }
    return text;
}

/// Keys with the tables that they are in; tables of a list by their number.
std::vector<Entry> entries_of(std::string_view text)
{
    std::vector<Entry> entries;
    std::map<std::string, int, std::less<>> count;
    std::string list, number, table;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        const std::string_view line = trimmed(without_comment(text.substr(0, end)));
        text.remove_prefix(std::min(end + 1, text.size()));
        if (line.starts_with("[[") && line.ends_with("]]")) {
            list = line.substr(2, line.size() - 4);
            number = fmt::format("{}.{}", list, count[list]++);
            table = number + '.';
            entries.push_back({number, "there"});
        } else if (line.starts_with('[') && line.ends_with(']')) {
            const std::string name(line.substr(1, line.size() - 2));
            const bool in_list = !list.empty() && name.starts_with(list + '.');
            table = (in_list ? number + name.substr(list.size()) : name) + '.';
        } else if (const std::size_t equals = line.find('='); equals != std::string_view::npos) {
            entries.push_back(
                {table + std::string(trimmed(line.substr(0, equals))), std::string(trimmed(line.substr(equals + 1)))});
        }
    }
    return entries;
}

std::map<std::string, std::string> by_key(const std::vector<Entry>& entries)
{
    std::map<std::string, std::string> values;
    for (const Entry& entry : entries)
        values.emplace(entry.key, entry.value);
    return values;
}

constexpr std::array without_influence{"title", "plugins.paths", "run.checkpoint_every"};

bool has_influence(const std::string& key)
{
    return std::ranges::find(without_influence, key) == without_influence.end();
}

std::vector<std::pair<std::string, std::string>> with_influence(std::string_view text)
{
    std::vector<std::pair<std::string, std::string>> pairs;
    for (const Entry& entry : entries_of(text))
        if (has_influence(entry.key))
            pairs.emplace_back(entry.key, entry.value);
    return pairs;
}

/// All keys that differ, with influence or without.
std::vector<std::string> differences(const std::string& there, const std::string& here, bool influence)
{
    const std::vector<Entry> before = entries_of(there), now = entries_of(here);
    const std::map<std::string, std::string> values_before = by_key(before), values_now = by_key(now);
    std::vector<std::string> found;
    for (const Entry& entry : before) {
        if (has_influence(entry.key) != influence)
            continue;
        const auto same = values_now.find(entry.key);
        if (same == values_now.end())
            found.push_back(fmt::format("{} is only there", entry.key));
        else if (same->second != entry.value)
            found.push_back(fmt::format("{} is {} there and {} here", entry.key, entry.value, same->second));
    }
    for (const Entry& entry : now)
        if (has_influence(entry.key) == influence && !values_before.contains(entry.key))
            found.push_back(fmt::format("{} is only here", entry.key));
    return found;
}

} // namespace

bool give_same_results(const std::string& there, const std::string& here)
{
    return there == here || with_influence(there) == with_influence(here);
}

std::vector<std::string> differences_without_influence(const std::string& there, const std::string& here)
{
    return differences(there, here, false);
}

std::string case_difference(const std::string& there, const std::string& here)
{
    for (const bool influence : {true, false})
        if (const std::vector<std::string> found = differences(there, here, influence); !found.empty())
            return found.front();
    return "its text differs";
}

} // namespace periporo
