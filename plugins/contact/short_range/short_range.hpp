// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Short-range repulsion between points of different bodies, and of grains that left their family.
#pragma once

#include "../common/spring_parameters.hpp"

#include <numbers>

namespace periporo {

/// A spring k (d_c - d), with a dashpot beside it when the restitution is below 1, at distances d below the cut-off
/// d_c; k is either a pair spring [N/m] or, with a contact
/// modulus C [Pa], k = 18 C V_a V_b/(pi delta^5), the stiffness of a bond of that modulus.
class ShortRange : public Contact {
public:
    static std::vector<Parameter> parameters()
    {
        std::vector<Parameter> records;
        SpringParameters::append_records(records, "k = 18 C V_a V_b/(pi delta^5)", "0.8 spacings");
        return records;
    }

    /// @throws std::invalid_argument unless exactly one of stiffness and modulus is given.
    explicit ShortRange(const Parameters& parameters) : spring_(parameters) {}

    void scale(const ContactScale& scale) override
    {
        cutoff_ = spring_.cutoff.value_or(0.8 * scale.spacing);
        const double h = scale.horizon;
        stiffness_per_volumes_ = 18.0 * spring_.modulus / (std::numbers::pi * h * h * h * h * h);
    }

    double cutoff() const override { return cutoff_; }
    double friction() const override { return spring_.friction; }

    void evaluate(std::span<const ContactPair> pairs, std::span<ContactResponse> responses) const override
    {
        for (std::size_t i = 0; i < pairs.size(); ++i) {
            const ContactPair& pair = pairs[i];
            const double k = spring_.stiffness.value_or(0.0) + stiffness_per_volumes_ * pair.volume_a * pair.volume_b;
            responses[i] =
                spring_and_dashpot(cutoff_ - pair.distance, k, spring_.ratio,
                                   pair.mass_a * pair.mass_b / (pair.mass_a + pair.mass_b), pair.approach_speed);
        }
    }

private:
    SpringParameters spring_;
    double cutoff_ = 0.0;
    double stiffness_per_volumes_ = 0.0; // 18 C/(pi delta^5) [N/m7]
};

} // namespace periporo
