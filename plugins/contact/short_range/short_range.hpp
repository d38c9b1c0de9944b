// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Short-range repulsion between points of different bodies, and of grains that left their family.
#pragma once

#include "periporo/contact.hpp"

#include <numbers>
#include <optional>
#include <stdexcept>

namespace periporo {

/// A spring k (d_c - d), with a dashpot beside it when the restitution is below 1, at distances d below the cut-off
/// d_c; k is either a pair spring [N/m] or, with a contact
/// modulus C [Pa], k = 18 C V_a V_b/(pi delta^5), the stiffness of a bond of that modulus.
class ShortRange : public Contact {
public:
    static std::vector<Parameter> parameters()
    {
        return {Parameter::real("stiffness", dimension::spring, "Spring between two points; this or `modulus`")
                    .above(0.0)
                    .optional(),
                Parameter::real("modulus", dimension::pressure,
                                "Contact modulus C, k = 18 C V_a V_b/(pi delta^5); this or `stiffness`")
                    .above(0.0)
                    .optional(),
                Parameter::real("cutoff", dimension::length, "Reach of the repulsion; 0.8 spacings when left out")
                    .above(0.0)
                    .optional(),
                Parameter::real("friction", dimension::none, "Coulomb coefficient of friction").at_least(0.0),
                Parameter::real("restitution", dimension::none,
                                "Coefficient of restitution of a collision; 1 for an elastic one")
                    .at_least(0.0)
                    .at_most(1.0)
                    .by_default(1.0)};
    }

    /// @throws std::invalid_argument unless exactly one of stiffness and modulus is given.
    explicit ShortRange(const Parameters& parameters)
        : friction_(parameters.real("friction")), damping_ratio_(damping_ratio(parameters.real("restitution")))
    {
        if (parameters.has("stiffness") == parameters.has("modulus"))
            throw std::invalid_argument("give exactly one of stiffness (N/m) and modulus (Pa)");
        if (parameters.has("stiffness"))
            stiffness_ = parameters.real("stiffness");
        else
            modulus_ = parameters.real("modulus");
        if (parameters.has("cutoff"))
            given_cutoff_ = parameters.real("cutoff");
    }

    void scale(const ContactScale& scale) override
    {
        cutoff_ = given_cutoff_.value_or(0.8 * scale.spacing);
        const double h = scale.horizon;
        stiffness_per_volumes_ = modulus_ > 0.0 ? 18.0 * modulus_ / (std::numbers::pi * h * h * h * h * h) : 0.0;
    }

    double cutoff() const override { return cutoff_; }
    double friction() const override { return friction_; }

    void evaluate(std::span<const ContactPair> pairs, std::span<ContactResponse> responses) const override
    {
        for (std::size_t i = 0; i < pairs.size(); ++i) {
            const ContactPair& pair = pairs[i];
            const double k = stiffness_ + stiffness_per_volumes_ * pair.volume_a * pair.volume_b;
            responses[i] =
                spring_and_dashpot(cutoff_ - pair.distance, k, damping_ratio_,
                                   pair.mass_a * pair.mass_b / (pair.mass_a + pair.mass_b), pair.approach_speed);
        }
    }

private:
    double friction_;
    double damping_ratio_;
    double stiffness_ = 0.0; // pair spring [N/m], or 0 with a modulus
    double modulus_ = 0.0;   // C [Pa], or 0 with a pair spring
    std::optional<double> given_cutoff_;
    double cutoff_ = 0.0;
    double stiffness_per_volumes_ = 0.0; // 18 C/(pi delta^5) [N/m7]
};

} // namespace periporo
