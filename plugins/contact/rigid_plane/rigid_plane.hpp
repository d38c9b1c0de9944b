// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// A fixed rigid plane that points of a body rest on and slide over.
#pragma once

#include "../common/linear_spring.hpp"

namespace periporo {

/// The reaction of `short_range` above a plane that the law brings along: k (d_c - d) at signed distances d below the
/// cut-off d_c, behind the plane too, with a dashpot beside it when the restitution is below 1. With the default
/// cut-off of half a spacing, points half a spacing above the plane just touch it.
class RigidPlane : public DampedContact<RigidPlane>, public RigidSurface {
public:
    static std::vector<Parameter> parameters()
    {
        std::vector<Parameter> records{Parameter::real_list("point", dimension::length, 3, "A point of the plane"),
                                       Parameter::real_list("normal", dimension::none, 3,
                                                            "Direction from the plane to the free side, any length")};
        LinearSpring::append_records(records, "k = C spacing");
        append_records(records, "cutoff", "Reach of the reaction", "half a spacing");
        return records;
    }

    /// @throws std::invalid_argument when the normal has no direction, or unless exactly one of stiffness and modulus
    /// is given.
    explicit RigidPlane(const Parameters& parameters)
        : DampedContact(parameters), spring_(parameters), point_(vector(parameters.real_list("point"))),
          normal_(vector(parameters.real_list("normal")))
    {
        const double length = normal_.stableNorm();
        if (!normal_.allFinite() || !(length > 0.0))
            throw std::invalid_argument("normal must be a direction: three numbers that are not all zero");
        normal_ /= length;
    }

    void scale(const ContactScale& scale) override
    {
        ContactScale above_plane = scale;
        above_plane.partner = ContactPartner::surface;
        DampedContact::scale(above_plane);
        spring_.scale(above_plane);
    }

    const RigidSurface* surface() const override { return this; }

    double distance(const Vector3& position, Vector3& normal) const override
    {
        normal = normal_;
        return normal_.dot(position - point_);
    }

    ContactResponse response(const ContactPair& pair) const { return linear_reaction(pair, spring_.stiffness(pair)); }

private:
    static Vector3 vector(const std::vector<double>& list) { return {list[0], list[1], list[2]}; }

    LinearSpring spring_;
    Vector3 point_;
    Vector3 normal_;
};

} // namespace periporo
