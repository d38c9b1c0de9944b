// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The linear spring of a contact, given as stiffness or as modulus.
#pragma once

#include "damped_contact.hpp"

#include <numbers>

namespace periporo {

/// k is either a spring [N/m] per contact or follows from a contact modulus C [Pa]: between points k = 18 C V_a V_b/(pi
/// delta^5), the stiffness of a bond of that modulus (Silling and Askari 2005), at a surface k = C dx, a lattice cell's
/// face dx^2 on a layer as thick as a cell is long.
class LinearSpring {
public:
    /// @param rule how k follows from the modulus
    static void append_records(std::vector<Parameter>& records, const std::string& rule)
    {
        records.push_back(Parameter::real("stiffness", dimension::spring, "Spring of one contact; this or `modulus`")
                              .above(0.0)
                              .optional());
        records.push_back(
            Parameter::real("modulus", dimension::pressure, "Contact modulus C, " + rule + "; this or `stiffness`")
                .above(0.0)
                .optional());
    }

    static constexpr const char* rule_for_both = "k = 18 C V_a V_b/(pi delta^5) between points, C spacing at a surface";

    /// @throws std::invalid_argument unless exactly one of stiffness and modulus is given.
    explicit LinearSpring(const Parameters& parameters)
    {
        if (first_of_two(parameters, "stiffness", "N/m", "modulus", "Pa"))
            per_contact_ = parameters.real("stiffness");
        else
            modulus_ = parameters.real("modulus");
    }

    void scale(const ContactScale& scale)
    {
        if (!modulus_)
            return;
        const double h = scale.horizon;
        if (scale.partner == ContactPartner::surface)
            per_contact_ = *modulus_ * scale.spacing;
        else
            per_volumes_ = 18.0 * *modulus_ / (std::numbers::pi * h * h * h * h * h);
    }

    /// k [N/m]
    double stiffness(const ContactPair& pair) const
    {
        return per_contact_ + per_volumes_ * (pair.volume_a * pair.volume_b); // to the last bit the same from b
    }

private:
    std::optional<double> modulus_; // C [Pa]
    double per_contact_ = 0.0;      // [N/m]
    double per_volumes_ = 0.0;      // 18 C/(pi delta^5) [N/m7]
};

} // namespace periporo
