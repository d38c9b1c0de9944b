// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Geometry plugin "slab": a substrate below a rectangular top face, which may be tilted.
#include "common/block.hpp"
#include "common/vector.hpp"

namespace periporo::geometry {

namespace {

class Slab : public Block {
public:
    static std::vector<Parameter> parameters()
    {
        return {Parameter::real_list("size", dimension::length, 2,
                                     "Edges of the top face along x and y, before they are tilted with it")
                    .above(0.0),
                Parameter::real("thickness", dimension::length, "Thickness below the top face").above(0.0),
                Parameter::real_list("top", dimension::length, 3, "Centre of the top face")
                    .by_default(std::vector<double>{0.0, 0.0, 0.0}),
                Parameter::real_list("normal", dimension::none, 3,
                                     "Direction out of the top face, of any length; z is tilted into it by the "
                                     "shortest turn")
                    .by_default(std::vector<double>{0.0, 0.0, 1.0})};
    }

    explicit Slab(const Parameters& parameters)
        : Block("slab", {"size[0]", "size[1]", "thickness"},
                Frame(Rotation::of_z_to(direction(parameters, "normal")), vector(parameters, "top")),
                region(parameters))
    {
    }

private:
    /// The top face is in the plane z = 0 of the frame, its centre in the origin.
    static Bounds region(const Parameters& parameters)
    {
        const double x = 0.5 * parameters.real_list("size").at(0);
        const double y = 0.5 * parameters.real_list("size").at(1);
        return {{-x, -y, -parameters.real("thickness")}, {x, y, 0.0}};
    }
};

} // namespace

} // namespace periporo::geometry

PERIPORO_PLUGIN(periporo::PluginKind::geometry, periporo::geometry::Slab, "slab", "A substrate with a plane top face")
