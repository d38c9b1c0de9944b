// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Pore pressures that are uniform, hydrostatic, or given by the rows of a file.
#include "water/pressure_field.hpp"

#include "periporo/csv_table.hpp"
#include "water/mixture.hpp"

#include <algorithm>
#include <boost/geometry/geometries/point.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <boost/geometry/strategies/strategies.hpp>
#include <cstddef>
#include <fmt/format.h>
#include <limits>
#include <stdexcept>
#include <utility>
#include <vector>

namespace periporo {
namespace {

class Uniform : public PressureField {
public:
    explicit Uniform(double suction) : suction_(suction) {}

    double at(const Vector3& /*place*/) const override { return 0.0 - suction_; }

private:
    double suction_;
};

class Hydrostatic : public PressureField {
public:
    Hydrostatic(const WaterDescription& water, const Vector3& gravity)
        : axis_(water.water_table.axis), level_(water.water_table.offset), slope_(-water_density * gravity[axis_]),
          largest_(water.largest.value_or(std::numeric_limits<double>::infinity()))
    {
    }

    double at(const Vector3& place) const override { return std::max(slope_ * (level_ - place[axis_]), -largest_); }

private:
    int axis_;
    double level_;   // [m]
    double slope_;   // [Pa/m]
    double largest_; // [Pa]
};

class NearestRow : public PressureField {
public:
    explicit NearestRow(const std::filesystem::path& file)
    {
        const CsvTable table = read_csv_table(file, {{"x", dimension::length},
                                                     {"y", dimension::length},
                                                     {"z", dimension::length},
                                                     {"suction", dimension::pressure}});
        suction_ = table.columns[3];
        if (suction_.empty())
            throw std::runtime_error(fmt::format("{}: it has no rows", file.string()));
        std::vector<std::pair<Place, std::size_t>> places;
        for (std::size_t row = 0; row < table.rows(); ++row) {
            if (suction_[row] < 0.0)
                throw std::runtime_error(
                    fmt::format("{}: suction is {:g} Pa; it is at least 0", table.place(row), suction_[row]));
            places.emplace_back(Place(table.columns[0][row], table.columns[1][row], table.columns[2][row]), row);
        }
        tree_ = Tree(places.begin(), places.end());
    }

    double at(const Vector3& place) const override
    {
        std::pair<Place, std::size_t> nearest;
        tree_.query(boost::geometry::index::nearest(Place(place.x(), place.y(), place.z()), 1), &nearest);
        return 0.0 - suction_[nearest.second];
    }

private:
    using Place = boost::geometry::model::point<double, 3, boost::geometry::cs::cartesian>;
    using Tree = boost::geometry::index::rtree<std::pair<Place, std::size_t>, boost::geometry::index::quadratic<16>>;

    std::vector<double> suction_; // [Pa]
    Tree tree_;
};

} // namespace

std::unique_ptr<PressureField> make_pressure_field(const WaterDescription& water, const Vector3& gravity)
{
    if (water.kind == WaterKind::hydrostatic)
        return std::make_unique<Hydrostatic>(water, gravity);
    if (water.kind == WaterKind::field)
        return std::make_unique<NearestRow>(water.file);
    return std::make_unique<Uniform>(water.suction);
}

} // namespace periporo
