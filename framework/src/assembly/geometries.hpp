// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The geometries of a case, with those that they are made of.
#pragma once

#include "case/description.hpp"
#include "plugins/registry.hpp"

#include <cstddef>
#include <map>
#include <memory>
#include <string>

namespace periporo {

/// Makes geometries; one of a name and that of a body are made once, when they are first needed. The case was checked:
/// names exist and no geometry is made of itself.
class Geometries {
public:
    Geometries(const CaseDescription& description, const PluginRegistry& registry)
        : description_(description), registry_(registry)
    {
    }

    /// @throws PluginError with what the plugin has against its parameters or operands.
    std::shared_ptr<const Geometry> make(const PluginChoice& choice);
    /// That of a body of the case, made once: a volume that is counted takes seconds.
    std::shared_ptr<const Geometry> of_body(std::size_t body);
    /// That of [geometry.NAME].
    std::shared_ptr<const Geometry> named(const std::string& name);

private:
    const CaseDescription& description_;
    const PluginRegistry& registry_;
    std::map<std::string, std::shared_ptr<const Geometry>> named_;
    std::map<std::size_t, std::shared_ptr<const Geometry>> of_bodies_;
};

} // namespace periporo
