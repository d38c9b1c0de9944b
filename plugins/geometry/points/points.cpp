// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Geometry plugin "points": material points made elsewhere.
#include "point_file.hpp"

#include "common/exact.hpp"

#include <boost/geometry/algorithms/disjoint.hpp>
#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/point.hpp>
#include <boost/geometry/index/rtree.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <utility>

namespace periporo::geometry {

namespace {

constexpr double largest_misfit = 0.2; ///< of the points' own spacing, as a part of the case's

class Points : public Geometry {
public:
    static std::vector<Parameter> parameters()
    {
        return {Parameter::file("file", "CSV with columns x, y, z [m] and volume [m3], or HDF5 with datasets position "
                                        "(n x 3) and volume (n)")};
    }

    explicit Points(const Parameters& parameters)
        : file_(read_points(parameters.text("file"))), cubes_(cubes_around(file_.points))
    {
    }

    /// In or on the cube around some point that has its volume.
    bool contains(const Vector3& position) const override
    {
        if (!position.allFinite())
            return false;
        const Corner here(position.x(), position.y(), position.z());
        return std::any_of(cubes_.qbegin(boost::geometry::index::intersects(here)), cubes_.qend(),
                           [&](const Cube& cube) { return is_in_cube(position, cube.second); });
    }

    Bounds bounds() const override
    {
        Bounds bounds{Vector3::Constant(std::numeric_limits<double>::infinity()),
                      Vector3::Constant(-std::numeric_limits<double>::infinity())};
        for (std::size_t p = 0; p < file_.points.positions.size(); ++p) {
            const Vector3 reach = Vector3::Constant(half_edge(file_.points.volumes[p]));
            bounds.lower = bounds.lower.cwiseMin(file_.points.positions[p] - reach);
            bounds.upper = bounds.upper.cwiseMax(file_.points.positions[p] + reach);
        }
        return bounds;
    }

    double volume() const override
    {
        return std::accumulate(file_.points.volumes.begin(), file_.points.volumes.end(), 0.0);
    }

    /// The points as they are.
    PointCloud fill(double spacing) const override
    {
        std::vector<double> volumes = file_.points.volumes;
        const auto middle = volumes.begin() + static_cast<std::ptrdiff_t>(volumes.size() / 2);
        std::nth_element(volumes.begin(), middle, volumes.end());
        const double own = std::cbrt(*middle);
        if (std::abs(own - spacing) > largest_misfit * spacing)
            file_.refuse(fmt::format("the median volume of its points is that of a cube of {:.6g} m, which is {:.3g} "
                                     "times the spacing of {:.6g} m; between {:.3g} and {:.3g} times will do, with a "
                                     "spacing of {:.6g} m it is 1",
                                     own, own / spacing, spacing, 1.0 - largest_misfit, 1.0 + largest_misfit, own));
        return file_.points;
    }

    std::vector<std::string> remarks() const override
    {
        std::vector<std::string> remarks{
            fmt::format("{}: {} points of {:.6g} m3 in all", file_.path, file_.points.volumes.size(), volume())};
        if (!file_.unused_columns.empty())
            remarks.push_back(
                fmt::format("{}: not used are the columns {}", file_.path, fmt::join(file_.unused_columns, ", ")));
        return remarks;
    }

private:
    using Corner = boost::geometry::model::point<double, 3, boost::geometry::cs::cartesian>;
    using Cube = std::pair<boost::geometry::model::box<Corner>, std::size_t>; ///< around a point, by its number
    using Cubes = boost::geometry::index::rtree<Cube, boost::geometry::index::rstar<16>>;

    static double half_edge(double volume) { return 0.5 * std::cbrt(volume); }

    /// Each wider than it is, by more than rounding.
    static Cubes cubes_around(const PointCloud& points)
    {
        std::vector<Cube> cubes;
        for (std::size_t p = 0; p < points.positions.size(); ++p) {
            const Vector3& centre = points.positions[p];
            const double half = half_edge(points.volumes[p]);
            const double reach = half + rounding * (half + centre.lpNorm<Eigen::Infinity>());
            cubes.push_back({{{centre.x() - reach, centre.y() - reach, centre.z() - reach},
                              {centre.x() + reach, centre.y() + reach, centre.z() + reach}},
                             p});
        }
        return Cubes(cubes);
    }

    bool is_in_cube(const Vector3& position, std::size_t point) const
    {
        const Vector3& centre = file_.points.positions[point];
        const double half = half_edge(file_.points.volumes[point]);
        const double beyond = (position - centre).lpNorm<Eigen::Infinity>() - half;
        const double doubt = rounding * (position.lpNorm<Eigen::Infinity>() + centre.lpNorm<Eigen::Infinity>() + half);
        if (std::abs(beyond) > doubt)
            return beyond < 0.0;
        const ExactVector offset = exact_point(position) - exact_point(centre);
        const auto is_within = [&](const Exact& component) { // |component| <= V^(1/3)/2
            return CGAL::abs(component * component * component) * 8 <= Exact(file_.points.volumes[point]);
        };
        return is_within(offset.x()) && is_within(offset.y()) && is_within(offset.z());
    }

    PointFile file_;
    Cubes cubes_;
};

} // namespace

} // namespace periporo::geometry

PERIPORO_PLUGIN(periporo::PluginKind::geometry, periporo::geometry::Points, "points", "Material points from a file")
