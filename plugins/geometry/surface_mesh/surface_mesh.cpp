// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Geometry plugin "surface_mesh": the body inside a closed surface of facets, from a file.
#include "surface.hpp"

#include "common/closed_mesh.hpp"
#include "common/frame.hpp"

#include "periporo/geometry.hpp"

#include <utility>

namespace periporo::geometry {

namespace {

class SurfaceMesh : public Geometry {
public:
    static std::vector<Parameter> parameters()
    {
        std::vector<Parameter> records;
        records.push_back(Parameter::file("file", "Closed surface of the body: .stl, .off, .ply or .obj"));
        records.push_back(
            Parameter::real("scale", dimension::length, "Length of one unit of the file's coordinates, as \"1 mm\"")
                .above(0.0)
                .by_default(1.0));
        for (Parameter& record : frame_parameters("Place of the file's point (0, 0, 0)"))
            records.push_back(std::move(record));
        return records;
    }

    explicit SurfaceMesh(const Parameters& parameters) : SurfaceMesh(read(parameters)) {}

    bool contains(const Vector3& position) const override { return body_.contains(position); }
    Bounds bounds() const override { return body_.bounds(); }
    double volume() const override { return body_.volume(); }
    bool has_distance() const override { return true; }
    double signed_distance(const Vector3& position, Vector3& normal) const override
    {
        const SignedDistance distance = body_.signed_distance(position);
        normal = distance.outward;
        return distance.value;
    }
    bool has_pieces() const override { return true; }
    void find_pieces(const Vector3& position, double reach, SurfacePieces& pieces) const override
    {
        body_.find_pieces(position, reach, pieces);
    }
    void find_pieces_from_within(const Vector3& position, double reach, SurfacePieces& pieces) const override
    {
        body_.find_pieces(position, reach, pieces);
    }
    std::vector<std::string> remarks() const override { return remarks_; }

private:
    static Surface read(const Parameters& parameters)
    {
        Surface surface(read_facets(parameters.text("file")));
        const double scale = parameters.real("scale");
        const Frame frame(parameters);
        surface.place([&](const Vector3& corner) { return frame.global(scale * corner); });
        surface.bound_body();
        return surface;
    }

    explicit SurfaceMesh(Surface surface) : remarks_(surface.remarks()), body_(std::move(surface).release()) {}

    std::vector<std::string> remarks_;
    ClosedMesh body_;
};

} // namespace

} // namespace periporo::geometry

PERIPORO_PLUGIN(periporo::PluginKind::geometry, periporo::geometry::SurfaceMesh, "surface_mesh",
                "The body inside a closed surface of facets")
