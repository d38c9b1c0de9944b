// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
#include "assembly/geometries.hpp"

#include <algorithm>

namespace periporo {

std::shared_ptr<const Geometry> Geometries::make(const PluginChoice& choice)
{
    std::shared_ptr<Geometry> geometry = registry_.make_geometry(choice.name, choice.parameters);
    for (const Parameter& record : registry_.require(PluginKind::geometry, choice.name).parameters) {
        if (record.naming != Naming::geometry)
            continue;
        std::vector<std::shared_ptr<const Geometry>> operands;
        for (const std::string& name : choice.parameters.text_list(record.name))
            operands.push_back(named(name));
        geometry->set_operands(std::move(operands));
    }
    return geometry;
}

std::shared_ptr<const Geometry> Geometries::of_body(std::size_t body)
{
    if (const auto made = of_bodies_.find(body); made != of_bodies_.end())
        return made->second;
    return of_bodies_.emplace(body, make(description_.bodies[body].geometry)).first->second;
}

std::shared_ptr<const Geometry> Geometries::named(const std::string& name)
{
    if (const auto made = named_.find(name); made != named_.end())
        return made->second;
    const auto described = std::find_if(description_.geometries.begin(), description_.geometries.end(),
                                        [&](const GeometryDescription& geometry) { return geometry.name == name; });
    return named_.emplace(name, make(described->plugin)).first->second;
}

} // namespace periporo
