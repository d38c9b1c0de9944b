// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Follows the path of an override and sets the value there.
#include "case/overrides.hpp"

#include "case/toml_depth.hpp"
#include "case/toml_source.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <optional>
#include <utility>

namespace periporo {
namespace {

std::string trimmed(const std::string& text)
{
    const std::size_t begin = text.find_first_not_of(' ');
    return begin == std::string::npos ? std::string() : text.substr(begin, text.find_last_not_of(' ') - begin + 1);
}

std::vector<std::string> split_path(const std::string& path)
{
    std::vector<std::string> keys;
    for (std::size_t begin = 0; begin <= path.size();) {
        const std::size_t end = std::min(path.find('.', begin), path.size());
        keys.push_back(trimmed(path.substr(begin, end - begin)));
        begin = end + 1;
    }
    return keys;
}

/// One override on its way.
class Override {
public:
    Override(const std::string& text, std::size_t order, const TableRules& rules, Diagnostics& diagnostics)
        : rules_(rules), diagnostics_(diagnostics)
    {
        auto source = std::make_shared<CaseSource>();
        source->override_text = text;
        source->order = order;
        place_.source = std::move(source);
    }

    void apply(CaseNode& root)
    {
        const std::string& text = place_.source->override_text;
        const std::size_t equals = text.find('=');
        const std::vector<std::string> keys = split_path(text.substr(0, std::min(equals, text.size())));
        if (equals == std::string::npos || std::find(keys.begin(), keys.end(), "") != keys.end())
            return fail("an override is written KEY=VALUE", "for example --set contact.0.friction=0.3");
        if (keys.size() > most_key_parts)
            return fail(fmt::format("the key has more than {} parts", most_key_parts),
                        "for example --set contact.0.friction=0.3");
        if (keys.front() == "include")
            return fail("'include' cannot be overridden", "write a case that includes both files");
        const std::optional<CaseNode> value = read_value(trimmed(text.substr(equals + 1)));
        CaseNode* node = &root;
        for (std::size_t i = 0; value && node != nullptr && i < keys.size(); ++i)
            node = descend(*node, keys, i);
        if (value && node != nullptr)
            *node = *value;
    }

private:
    std::nullopt_t refuse(const std::string& message, const std::string& hint)
    {
        fail(message, hint);
        return std::nullopt;
    }

    void fail(const std::string& message, const std::string& hint) { diagnostics_.error(place_, message, hint); }

    std::optional<CaseNode> read_value(const std::string& text)
    {
        if (std::optional<CaseNode> value = parse_toml_value(text, place_.source))
            return value;
        if (text.empty())
            return refuse("the value is empty", "write KEY=VALUE; an empty text is '\"\"'");
        if (std::string_view("[{\"'").find(text.front()) != std::string_view::npos)
            return refuse(fmt::format("{} is not a TOML value", text), "mind the quotes that the shell takes away");
        return CaseNode{text, place_};
    }

    CaseNode* descend(CaseNode& node, const std::vector<std::string>& keys, std::size_t depth)
    {
        if (node.table() != nullptr)
            return enter_table(node, keys, depth);
        if (node.array() != nullptr && depth > 0)
            return enter_list(*node.array(), keys[depth], keys[depth - 1]);
        fail(fmt::format("'{}' holds {} and has no '{}'", keys[depth - 1], found_text(node), keys[depth]), {});
        return nullptr;
    }

    CaseNode* enter_table(CaseNode& table, const std::vector<std::string>& keys, std::size_t depth)
    {
        const std::string& key = keys[depth];
        const bool last = depth + 1 == keys.size();
        if (CaseEntry* entry = table.find(key)) {
            if (last)
                entry->place = place_;
            return &entry->node;
        }
        if (depth == 1 && is_named(keys.front())) {
            std::vector<std::string> names;
            for (const CaseEntry& entry : *table.table())
                names.push_back(entry.key);
            fail(fmt::format("there is no [{}.{}] to override", keys.front(), key),
                 naming_hint(key, names, "names of the case"));
            return nullptr;
        }
        // A path that goes on makes the table on the way; the last key holds the value.
        CaseNode fresh{CaseNode::Table{}, place_};
        if (last)
            fresh.value = CaseNode::Other{};
        table.table()->push_back({key, place_, std::move(fresh)});
        return &table.table()->back().node;
    }

    bool is_named(const std::string& section) const
    {
        return std::any_of(rules_.nested.begin(), rules_.nested.end(), [&](const NestedRules& nested) {
            return nested.name == section && nested.shape == TableShape::named;
        });
    }

    CaseNode* enter_list(CaseNode::Array& list, const std::string& key, const std::string& list_name)
    {
        std::size_t index = 0;
        const auto [end, error] = std::from_chars(key.data(), key.data() + key.size(), index);
        if (error == std::errc{} && end == key.data() + key.size()) {
            if (index < list.size())
                return &list[index];
            fail(fmt::format("there is no {}.{}", list_name, index),
                 fmt::format("'{}' has {} entries, counted from 0", list_name, list.size()));
            return nullptr;
        }
        std::vector<std::string> names;
        for (CaseNode& entry : list) {
            const CaseEntry* name = entry.find("name");
            if (name == nullptr || name->node.text() == nullptr)
                continue;
            if (*name->node.text() == key)
                return &entry;
            names.push_back(*name->node.text());
        }
        const std::string by_number =
            fmt::format("'{}' has {} entries; a number from 0 chooses one", list_name, list.size());
        fail(fmt::format("there is no entry '{}' in '{}'", key, list_name),
             names.empty() ? by_number : naming_hint(key, names, "names of the case") + "\n" + by_number);
        return nullptr;
    }

    const TableRules& rules_;
    Diagnostics& diagnostics_;
    Place place_;
};

} // namespace

void apply_overrides(CaseNode& root, const std::vector<std::string>& overrides, const TableRules& rules,
                     Diagnostics& diagnostics)
{
    constexpr std::size_t after_all_files = 1'000'000;
    for (std::size_t i = 0; i < overrides.size(); ++i)
        Override(overrides[i], after_all_files + i, rules, diagnostics).apply(root);
}

} // namespace periporo
