// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The geometries of a case, with those that they are made of.
#pragma once

#include "case/description.hpp"
#include "plugins/registry.hpp"

#include <map>
#include <memory>
#include <string>

namespace periporo {

/// Makes geometries; one of a name is made once, when it is first asked for. The case was checked: names exist and no
/// geometry is made of itself.
class Geometries {
public:
    Geometries(const CaseDescription& description, const PluginRegistry& registry)
        : description_(description), registry_(registry)
    {
    }

    /// @throws PluginError with what the plugin has against its parameters or operands.
    std::shared_ptr<const Geometry> make(const PluginChoice& choice);
    /// That of [geometry.NAME].
    std::shared_ptr<const Geometry> named(const std::string& name);

private:
    const CaseDescription& description_;
    const PluginRegistry& registry_;
    std::map<std::string, std::shared_ptr<const Geometry>> named_;
};

} // namespace periporo
