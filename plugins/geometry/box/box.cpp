// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Geometry plugin "box": a rectangular block, which may be turned about its origin.
#include "common/block.hpp"
#include "common/vector.hpp"

namespace periporo::geometry {

namespace {

class Box : public Block {
public:
    static std::vector<Parameter> parameters()
    {
        std::vector<Parameter> records =
            frame_parameters("Corner from which the edges go out; the lower corner when not rotated");
        records.insert(
            records.begin(),
            Parameter::real_list("size", dimension::length, 3, "Edges along the box's own x, y and z").above(0.0));
        return records;
    }

    explicit Box(const Parameters& parameters)
        : Block("box", {"size[0]", "size[1]", "size[2]"}, Frame(parameters),
                {Vector3::Zero(), vector(parameters, "size")})
    {
    }
};

} // namespace

} // namespace periporo::geometry

PERIPORO_PLUGIN(periporo::PluginKind::geometry, periporo::geometry::Box, "box", "A rectangular block")
