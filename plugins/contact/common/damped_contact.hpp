// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// What all contact laws of this folder have in common.
#pragma once

#include "periporo/contact.hpp"

#include <cstddef>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace periporo {

/// Distance of first touch, friction and restitution, and the loop over `Law::response(pair)`, the law itself. When the
/// distance is left out, points touch at 0.8 spacings (that of neighbours in one body is 1) and at half a spacing above
/// a surface, where the outermost points of a body made of whole cells lie.
template <class Law>
class DampedContact : public Contact {
public:
    void scale(const ContactScale& scale) override
    {
        touch_ = given_touch_.value_or((scale.partner == ContactPartner::surface ? 0.5 : 0.8) * scale.spacing);
    }

    double cutoff() const override { return touch_; }
    double friction() const override { return friction_; }

    void evaluate(std::span<const ContactPair> pairs, std::span<ContactResponse> responses) const override
    {
        for (std::size_t i = 0; i < pairs.size(); ++i)
            responses[i] = static_cast<const Law&>(*this).response(pairs[i]);
    }

protected:
    /// @param touch name of the distance of first touch
    /// @param touch_meaning its documentation, without the default
    static void append_records(std::vector<Parameter>& records, const std::string& touch = "cutoff",
                               const std::string& touch_meaning = "Reach of the reaction",
                               const std::string& default_touch = "0.8 spacings, half a spacing above a surface,")
    {
        records.push_back(
            Parameter::real(touch, dimension::length, touch_meaning + "; " + default_touch + " when left out")
                .above(0.0)
                .optional());
        records.push_back(
            Parameter::real("friction", dimension::none, "Coulomb coefficient of friction").at_least(0.0));
        records.push_back(Parameter::real("restitution", dimension::none,
                                          "Coefficient of restitution of a collision; 1 for an elastic one, below 0.05 "
                                          "as 0.05")
                              .at_least(0.0)
                              .at_most(1.0)
                              .by_default(1.0));
    }

    explicit DampedContact(const Parameters& parameters, const std::string& touch = "cutoff")
        : friction_(parameters.real("friction")), damping_ratio_(damping_ratio(parameters.real("restitution")))
    {
        if (parameters.has(touch))
            given_touch_ = parameters.real(touch);
    }

    /// Distance of first touch [m].
    double touch() const { return touch_; }
    double ratio() const { return damping_ratio_; }

    /// A spring k [N/m] below the distance of first touch with the dashpot of the restitution beside it.
    ContactResponse linear_reaction(const ContactPair& pair, double stiffness) const
    {
        return spring_and_dashpot(touch_ - pair.distance, stiffness, damping_ratio_, pair);
    }

private:
    std::optional<double> given_touch_; // [m]
    double touch_ = 0.0;                // [m]
    double friction_;
    double damping_ratio_;
};

/// @throws std::invalid_argument unless exactly one of two parameters is given.
/// @return whether it is the first
inline bool first_of_two(const Parameters& parameters, const std::string& first, const std::string& first_unit,
                         const std::string& second, const std::string& second_unit)
{
    const bool has_first = parameters.has(first);
    if (has_first == parameters.has(second))
        throw std::invalid_argument("give exactly one of " + first + " (" + first_unit + ") and " + second + " (" +
                                    second_unit + ")");
    return has_first;
}

} // namespace periporo
