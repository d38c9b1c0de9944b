// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Influence functions omega(|zeta|): how much a bond counts by its length.
#pragma once

#include "periporo/pack.hpp"
#include "plugins/built_in.hpp"

#include <stdexcept>
#include <string>
#include <vector>

namespace periporo {

/// With x = r/delta:
///     constant           1
///     linear             1 - x
///     quadratic          (1 - x)^2
///     gaussian           exp(-(2x)^2), about 0.02 at the horizon
///     cubic_b_spline     1 - 6x^2 + 6x^3 up to x = 1/2, then 2(1 - x)^3 (Monaghan and Lattanzio 1985, support delta)
///     inverse_distance   1/x, held at 10 below x = 1/10 so that it stays finite
/// linear, quadratic and cubic_b_spline vanish at the horizon: bonds come and go at zero weight.
enum class InfluenceKind { constant, linear, quadratic, gaussian, cubic_b_spline, inverse_distance };

struct NamedInfluence {
    InfluenceKind kind;
    const char* name;
};
/// All influence functions by name. A new one is added here and in Influence::operator().
inline constexpr NamedInfluence influence_table[] = {
    {InfluenceKind::constant, "constant"},
    {InfluenceKind::linear, "linear"},
    {InfluenceKind::quadratic, "quadratic"},
    {InfluenceKind::gaussian, "gaussian"},
    {InfluenceKind::cubic_b_spline, "cubic_b_spline"},
    {InfluenceKind::inverse_distance, "inverse_distance"},
};

/// omega for one horizon; `Real` is double or Pack.
class Influence {
public:
    Influence(InfluenceKind kind, double horizon) : kind_(kind), reciprocal_(1.0 / horizon)
    {
        constexpr int intervals = 1000; // midpoints: exact to 1e-6, kinks included
        double weight = 0.0, moment = 0.0;
        for (int n = 0; n < intervals; ++n) {
            const double r = (n + 0.5) / intervals * horizon;
            weight += (*this)(r * r) * r * r;
            moment += (*this)(r * r) * r * r * r * r;
        }
        second_moment_ = moment / (3.0 * weight);
    }

    /// @throws std::invalid_argument for a name that is not in influence_names().
    static Influence by_name(const std::string& name, double horizon);

    /// Mean of zeta_x^2 over a whole ball, weighted with omega: the shape tensor of a full family is this times its
    /// weight. delta^2/5 for `constant`. [m2]
    double second_moment() const { return second_moment_; }

    template <class Real>
    Real operator()(const Real& length_squared) const
    {
        if (kind_ == InfluenceKind::constant)
            return Real(1.0);
        if (kind_ == InfluenceKind::gaussian)
            return exponential(length_squared * (-4.0 * reciprocal_ * reciprocal_));
        const Real x = square_root(length_squared) * reciprocal_;
        const Real left = maximum(Real(1.0) - x, Real(0.0));
        switch (kind_) {
        case InfluenceKind::linear:
            return left;
        case InfluenceKind::quadratic:
            return left * left;
        case InfluenceKind::cubic_b_spline:
            return select(x < Real(0.5), Real(1.0 + 6.0 * x * x * (x - 1.0)), Real(2.0 * left * left * left));
        default:
            return 1.0 / maximum(x, Real(0.1)); // inverse_distance
        }
    }

private:
    InfluenceKind kind_;
    double reciprocal_;
    double second_moment_ = 0.0;
};

} // namespace periporo
