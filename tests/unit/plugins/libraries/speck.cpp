// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The smallest geometry plugin, as it should be: a cube about the origin.
#include "periporo/geometry.hpp"

#include <stdexcept>

namespace {

class Speck : public periporo::Geometry {
public:
    static std::vector<periporo::Parameter> parameters()
    {
        std::vector<periporo::Parameter> records;
        records.push_back(periporo::Parameter::real("width", periporo::dimension::length, "Edge of the cube"));
        return records;
    }

    explicit Speck(const periporo::Parameters& parameters) : width_(parameters.real("width"))
    {
        if (width_ > 1.0)
            throw std::runtime_error("a speck is not wider than 1 m");
    }

    bool contains(const periporo::Vector3& position) const override
    {
        return position.lpNorm<Eigen::Infinity>() <= width_ / 2;
    }
    periporo::Bounds bounds() const override
    {
        return {periporo::Vector3::Constant(-width_ / 2), periporo::Vector3::Constant(width_ / 2)};
    }
    double volume() const override { return width_ * width_ * width_; }
    periporo::PointCloud fill(double) const override { return {{periporo::Vector3::Zero()}, {volume()}}; }

private:
    double width_;
};

} // namespace

PERIPORO_PLUGIN(periporo::PluginKind::geometry, Speck, "speck", "A cube about the origin")
