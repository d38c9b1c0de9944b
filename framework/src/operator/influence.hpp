// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Influence functions omega(|zeta|): how much a bond counts by its length.
#pragma once

#include "periporo/pack.hpp"

#include <stdexcept>
#include <string>
#include <vector>

namespace periporo {

/// `constant` 1; `linear` 1 - r/delta, zero at the horizon; `gaussian` exp(-(2 r/delta)^2), about 0.02 at the horizon.
enum class InfluenceKind { constant, linear, gaussian };

inline const std::vector<std::string>& influence_names()
{
    static const std::vector<std::string> names{"constant", "linear", "gaussian"};
    return names;
}

/// omega for one horizon; `Real` is double or Pack.
class Influence {
public:
    Influence(InfluenceKind kind, double horizon) : kind_(kind), reciprocal_(1.0 / horizon) {}

    /// @throws std::invalid_argument for a name that is not in influence_names().
    static Influence by_name(const std::string& name, double horizon)
    {
        for (std::size_t n = 0; n < influence_names().size(); ++n)
            if (influence_names()[n] == name)
                return {static_cast<InfluenceKind>(n), horizon};
        throw std::invalid_argument("no influence function is called '" + name + "'");
    }

    InfluenceKind kind() const { return kind_; }

    template <class Real>
    Real operator()(const Real& length_squared) const
    {
        switch (kind_) {
        case InfluenceKind::linear:
            return maximum(Real(1.0) - square_root(length_squared) * reciprocal_, Real(0.0));
        case InfluenceKind::gaussian:
            return exponential(length_squared * (-4.0 * reciprocal_ * reciprocal_));
        case InfluenceKind::constant:
            break;
        }
        return Real(1.0);
    }

private:
    InfluenceKind kind_;
    double reciprocal_;
};

} // namespace periporo
