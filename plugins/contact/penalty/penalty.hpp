// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The normal stiffness of an interface, as geotechnical codes have it.
#pragma once

#include "../common/damped_contact.hpp"
#include "../common/face_area.hpp"

namespace periporo {

/// Normal stress k_n o under the overlap o = d_c - d, on the face V^(2/3) of the point, with a dashpot beside it when
/// the restitution is below 1. k_n is given [Pa/m] or follows from a modulus C, k_n = C/dx: with C the oedometric
/// modulus K + 4 G/3 of a soil, the contact is as stiff as one more layer of cells.
class Penalty : public DampedContact<Penalty> {
public:
    static std::vector<Parameter> parameters()
    {
        std::vector<Parameter> records{
            Parameter::real("normal_stiffness", dimension::pressure_per_length,
                            "Normal stress k_n per overlap; this or `modulus`")
                .above(0.0)
                .optional(),
            Parameter::real("modulus", dimension::pressure, "C of k_n = C/spacing; this or `normal_stiffness`")
                .above(0.0)
                .optional()};
        append_records(records);
        return records;
    }

    /// @throws std::invalid_argument unless exactly one of normal_stiffness and modulus is given.
    explicit Penalty(const Parameters& parameters) : DampedContact(parameters)
    {
        if (first_of_two(parameters, "normal_stiffness", "Pa/m", "modulus", "Pa"))
            normal_stiffness_ = parameters.real("normal_stiffness");
        else
            modulus_ = parameters.real("modulus");
    }

    void scale(const ContactScale& scale) override
    {
        DampedContact::scale(scale);
        partner_ = scale.partner;
        if (modulus_)
            normal_stiffness_ = *modulus_ / scale.spacing;
    }

    ContactResponse response(const ContactPair& pair) const
    {
        return linear_reaction(pair, normal_stiffness_ * face_area(pair, partner_));
    }

private:
    std::optional<double> modulus_; // C [Pa]
    double normal_stiffness_ = 0.0; // k_n [Pa/m]
    ContactPartner partner_ = ContactPartner::points;
};

} // namespace periporo
