// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Influence functions by name.
#include "operator/influence.hpp"

namespace periporo {

const std::vector<std::string>& influence_names()
{
    static const std::vector<std::string> names = [] {
        std::vector<std::string> all;
        for (const NamedInfluence& one : influence_table)
            all.emplace_back(one.name);
        return all;
    }();
    return names;
}

Influence Influence::by_name(const std::string& name, double horizon)
{
    for (const NamedInfluence& one : influence_table)
        if (one.name == name)
            return {one.kind, horizon};
    throw std::invalid_argument("no influence function is called '" + name + "'");
}

} // namespace periporo
