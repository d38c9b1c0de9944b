// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// A fixed rigid plane that points of a body rest on and slide over.
#pragma once

#include "../common/spring_parameters.hpp"

#include <cmath>

namespace periporo {

/// A spring k (d_c - d), with a dashpot beside it when the restitution is below 1, at signed distances d below the
/// cut-off d_c, behind the plane too. With the default cut-off of half a spacing, points half a spacing above the plane
/// just touch it. k is either a spring [N/m] per point or, with a contact modulus C [Pa], k = C dx: a lattice cell's
/// face dx^2 on a layer as thick as a cell is long.
class RigidPlane : public Contact, public RigidSurface {
public:
    static std::vector<Parameter> parameters()
    {
        std::vector<Parameter> records{Parameter::real_list("point", dimension::length, 3, "A point of the plane"),
                                       Parameter::real_list("normal", dimension::none, 3,
                                                            "Direction from the plane to the free side, any length")};
        SpringParameters::append_records(records, "k = C spacing", "half a spacing");
        return records;
    }

    /// @throws std::invalid_argument when the normal has no direction, or unless exactly one of stiffness and modulus
    /// is given.
    explicit RigidPlane(const Parameters& parameters)
        : spring_(parameters), point_(vector(parameters.real_list("point"))),
          normal_(vector(parameters.real_list("normal")))
    {
        const double length = normal_.stableNorm();
        if (!normal_.allFinite() || !(length > 0.0))
            throw std::invalid_argument("normal must be a direction: three numbers that are not all zero");
        normal_ /= length;
    }

    void scale(const ContactScale& scale) override
    {
        cutoff_ = spring_.cutoff.value_or(0.5 * scale.spacing);
        stiffness_ = spring_.stiffness.value_or(spring_.modulus * scale.spacing);
    }

    double cutoff() const override { return cutoff_; }
    double friction() const override { return spring_.friction; }
    const RigidSurface* surface() const override { return this; }

    double distance(const Vector3& position, Vector3& normal) const override
    {
        normal = normal_;
        return normal_.dot(position - point_);
    }

    void evaluate(std::span<const ContactPair> pairs, std::span<ContactResponse> responses) const override
    {
        for (std::size_t i = 0; i < pairs.size(); ++i)
            responses[i] = spring_and_dashpot(cutoff_ - pairs[i].distance, stiffness_, spring_.ratio, pairs[i].mass_a,
                                              pairs[i].approach_speed);
    }

private:
    static Vector3 vector(const std::vector<double>& list) { return {list[0], list[1], list[2]}; }

    SpringParameters spring_;
    Vector3 point_;
    Vector3 normal_;
    double stiffness_ = 0.0; // [N/m]
    double cutoff_ = 0.0;    // [m]
};

} // namespace periporo
