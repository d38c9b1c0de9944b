// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Short-range repulsion: of points of different bodies, of grains that left their family, of points and a surface.
#pragma once

#include "../common/linear_spring.hpp"

namespace periporo {

/// A spring k (d_c - d), with a dashpot beside it when the restitution is below 1, at distances d below the cut-off
/// d_c; k as LinearSpring has it.
class ShortRange : public DampedContact<ShortRange> {
public:
    static std::vector<Parameter> parameters()
    {
        std::vector<Parameter> records;
        LinearSpring::append_records(records, LinearSpring::rule_for_both);
        append_records(records);
        return records;
    }

    /// @throws std::invalid_argument unless exactly one of stiffness and modulus is given.
    explicit ShortRange(const Parameters& parameters) : DampedContact(parameters), spring_(parameters) {}

    void scale(const ContactScale& scale) override
    {
        DampedContact::scale(scale);
        spring_.scale(scale);
    }

    ContactResponse response(const ContactPair& pair) const { return linear_reaction(pair, spring_.stiffness(pair)); }

private:
    LinearSpring spring_;
};

} // namespace periporo
