// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Geometry plugin "prism": a simple polygon with height, which may be turned about its origin.
#include "polygon.hpp"

#include "common/frame.hpp"

#include <CGAL/Polygon_2_algorithms.h>

#include <algorithm>
#include <limits>

namespace periporo::geometry {

namespace {

class Prism : public Geometry {
public:
    static std::vector<Parameter> parameters()
    {
        std::vector<Parameter> records = frame_parameters("Where the prism's own x, y and z are zero");
        records.insert(records.begin(),
                       {Parameter::real_list("polygon", dimension::length, 0,
                                             "Corners x0, y0, x1, y1, ... of the base in the prism's own plane z = 0, "
                                             "either way round"),
                        Parameter::real("height", dimension::length, "Height along the prism's own z").above(0.0)});
        return records;
    }

    explicit Prism(const Parameters& parameters)
        : polygon_(parameters.real_list("polygon")), height_(parameters.real("height")), frame_(parameters),
          volume_(polygon_.area() * height_), scaled_corners_(polygon_.exact_corners(frame_.scale()))
    {
    }

    bool contains(const Vector3& position) const override
    {
        if (!position.allFinite())
            return false;
        const Vector3 local = frame_.local(position);
        const double doubt = frame_.doubt(position) + rounding * size();
        if (local.z() < -doubt || local.z() > height_ + doubt)
            return false;
        const double beside = polygon_.distance(local.x(), local.y()).value;
        if (beside > doubt)
            return false;
        if (local.z() > doubt && local.z() < height_ - doubt && beside < -doubt)
            return true;
        return contains_exactly(position);
    }

    Bounds bounds() const override
    {
        Bounds bounds{Vector3::Constant(std::numeric_limits<double>::infinity()),
                      Vector3::Constant(-std::numeric_limits<double>::infinity())};
        for (const Polygon::Point& corner : polygon_.corners())
            for (const double z : {0.0, height_}) {
                const Vector3 position = frame_.global({corner.x(), corner.y(), z});
                bounds = {bounds.lower.cwiseMin(position), bounds.upper.cwiseMax(position)};
            }
        return bounds;
    }

    double volume() const override { return volume_; }

    /// A lattice along the prism's own axes with a corner of cells in its origin.
    PointCloud fill(double spacing) const override
    {
        return fill_by_lattice(*this, spacing, {frame_.origin(), frame_.axes(), own_bounds()});
    }

    bool has_distance() const override { return true; }

    double signed_distance(const Vector3& position, Vector3& normal) const override
    {
        const Vector3 local = frame_.local(position);
        const SignedDistance distance = distance_from_common(
            polygon_.distance(local.x(), local.y()), distance_from_layer(local.z(), 0.0, height_, Vector3::UnitZ()));
        normal = frame_.axes() * distance.outward;
        return distance.value;
    }

    bool has_pieces() const override { return !polygon_.is_convex(); }

    void find_pieces(const Vector3& position, double reach, SurfacePieces& pieces) const override
    {
        if (polygon_.is_convex())
            return Geometry::find_pieces(position, reach, pieces);
        const Vector3 local = frame_.local(position);
        add_sides(local, reach, pieces);
        const SignedDistance end = distance_from_layer(local.z(), 0.0, height_, Vector3::UnitZ());
        if (end.value < reach && polygon_.distance(local.x(), local.y()).value <= 0.0)
            pieces.add(end.value, frame_.axes() * end.outward);
    }

    void find_pieces_from_within(const Vector3& position, double reach, SurfacePieces& pieces) const override
    {
        const Vector3 local = frame_.local(position);
        add_sides(local, reach, pieces);
        if (local.z() < reach)
            pieces.add(local.z(), frame_.axes().col(2));
        if (const double to_top = height_ - local.z(); to_top < reach)
            pieces.add(to_top, -frame_.axes().col(2));
    }

private:
    /// The rectangles beside, seen from either side of them.
    void add_sides(const Vector3& local, double reach, SurfacePieces& pieces) const
    {
        const SignedDistance end = distance_from_layer(local.z(), 0.0, height_, Vector3::UnitZ());
        polygon_.for_each_edge(local.x(), local.y(), reach, [&](double distance, const Eigen::Vector2d& away) {
            const SignedDistance side = distance_from_common({distance, Vector3(away.x(), away.y(), 0.0)},
                                                             {std::max(end.value, 0.0), end.outward});
            if (side.value < reach)
                pieces.add(side.value, frame_.axes() * side.outward);
        });
    }

    Bounds own_bounds() const
    {
        return {{polygon_.lower().x(), polygon_.lower().y(), 0.0},
                {polygon_.upper().x(), polygon_.upper().y(), height_}};
    }

    /// The largest coordinate, for bounds of rounding.
    double size() const
    {
        return std::max(own_bounds().lower.lpNorm<Eigen::Infinity>(), own_bounds().upper.lpNorm<Eigen::Infinity>());
    }

    bool contains_exactly(const Vector3& position) const
    {
        const ExactPoint local = frame_.scaled_local(position);
        if (CGAL::is_negative(local.z()) || local.z() > frame_.scale() * Exact(height_))
            return false;
        const Polygon::ExactPoint2 beside(local.x(), local.y());
        return CGAL::bounded_side_2(scaled_corners_.begin(), scaled_corners_.end(), beside, ExactKernel()) !=
               CGAL::ON_UNBOUNDED_SIDE;
    }

    Polygon polygon_;
    double height_;
    Frame frame_;
    double volume_;
    std::vector<Polygon::ExactPoint2> scaled_corners_; ///< times the scale of the frame
};

} // namespace

} // namespace periporo::geometry

PERIPORO_PLUGIN(periporo::PluginKind::geometry, periporo::geometry::Prism, "prism", "A polygon with height")
