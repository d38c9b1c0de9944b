// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Short-range repulsion with cohesion: what touched must be pulled apart.
#pragma once

#include "../common/face_area.hpp"
#include "../common/linear_spring.hpp"

#include <fmt/format.h>

namespace periporo {

/// A spring k (d_0 - d) that pushes below the contact distance d_0, pulls with the same slope above it until the pull
/// is P, and then lets go along a line that ends at d_0 + range; k as LinearSpring has it. In tension this is the
/// bilinear cohesive law with the stiffness of the contact as its rising part (Camanho and Davila 2002,
/// NASA/TM-2002-211737), but recoverable: it heals as it opened. The work of separation is W = P range/2.
///
/// P is strength x the face of the point, but never more than k range/2, so that no part of the law is steeper than
/// the spring; scale() refuses a strength that a whole cell could not have, so the limit is met by smaller points
/// alone, whose springs are soft. A dashpot acts while the contact presses, and never pulls.
class Adhesive : public DampedContact<Adhesive> {
public:
    static std::vector<Parameter> parameters()
    {
        std::vector<Parameter> records;
        LinearSpring::append_records(records, LinearSpring::rule_for_both);
        records.push_back(
            Parameter::real("strength", dimension::pressure, "Greatest pull per face of a point").above(0.0));
        records.push_back(Parameter::real("range", dimension::length,
                                          "From contact distance to no pull; a quarter of a spacing when left out")
                              .above(0.0)
                              .optional());
        append_records(records, touch_name, "Distance without force, between pushing and pulling");
        return records;
    }

    /// @throws std::invalid_argument unless exactly one of stiffness and modulus is given.
    explicit Adhesive(const Parameters& parameters)
        : DampedContact(parameters, touch_name), spring_(parameters), strength_(parameters.real("strength"))
    {
        if (parameters.has("range"))
            given_range_ = parameters.real("range");
    }

    /// @throws std::invalid_argument when the spring is too soft for the strength.
    void scale(const ContactScale& scale) override
    {
        DampedContact::scale(scale);
        spring_.scale(scale);
        partner_ = scale.partner;
        range_ = given_range_.value_or(0.25 * scale.spacing);
        const double volume = scale.spacing * scale.spacing * scale.spacing;
        const ContactPair cells{0.0, 0.0, volume, volume, 0.0, 0.0};
        const double most = steepest_pull(spring_.stiffness(cells)) / face_area(cells, partner_);
        if (strength_ > most)
            throw std::invalid_argument(
                fmt::format("contact 'adhesive': its strength of {:.4g} Pa is too much for its spring, which pulls at "
                            "most {:.4g} Pa, k range/2 on the face of a cell; raise modulus (or stiffness) or range",
                            strength_, most));
    }

    double cutoff() const override { return touch() + range_; }

    ContactResponse response(const ContactPair& pair) const
    {
        const double left = cutoff() - pair.distance;
        if (left <= 0.0)
            return {};
        const double opening = pair.distance - touch();
        const double k = spring_.stiffness(pair);
        const double pull = std::min(strength_ * face_area(pair, partner_), steepest_pull(k));
        const double work = 0.5 * pull * range_;
        if (opening < 0.0) {
            ContactResponse pressed = linear_reaction(pair, k);
            pressed.energy -= work;
            return pressed;
        }
        if (k * opening <= pull)
            return {-k * opening, k, 0.5 * k * opening * opening - work, 0.0};
        const double slope = pull / (range_ - pull / k);
        return {-slope * left, -slope, -0.5 * slope * left * left, 0.0};
    }

private:
    static constexpr const char* touch_name = "contact_distance";

    /// The pull k range/2, whose fall is as steep as its rise.
    double steepest_pull(double stiffness) const { return 0.5 * stiffness * range_; }

    LinearSpring spring_;
    double strength_;                   // [Pa]
    std::optional<double> given_range_; // [m]
    double range_ = 0.0;                // [m]
    ContactPartner partner_ = ContactPartner::points;
};

} // namespace periporo
