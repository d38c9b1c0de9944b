// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Isotropic linear elasticity in rate form: the increment of effective stress by Hooke's law.
#pragma once

#include "periporo/material_law.hpp"

#include <limits>

namespace periporo {

/// sigma' = sigma'_rotated + K tr(D dt) 1 + 2 G dev(D dt). No internal variables; fails only where a number is
/// not finite.
class LinearElastic {
public:
    static constexpr std::size_t state_count = 0;
    static constexpr bool closes = false; // a solid

    static std::vector<Parameter> parameters()
    {
        return {Parameter::real("bulk_modulus", dimension::pressure, "Bulk modulus K of the skeleton").above(0.0),
                Parameter::real("shear_modulus", dimension::pressure, "Shear modulus G of the skeleton").above(0.0)};
    }

    static std::vector<StateVariable> state_variables() { return {}; }

    explicit LinearElastic(const Parameters& parameters)
        : bulk_modulus_(parameters.real("bulk_modulus")), shear_modulus_(parameters.real("shear_modulus"))
    {
    }

    double bulk_modulus() const { return bulk_modulus_; }
    double shear_modulus() const { return shear_modulus_; }

    template <class Real>
    LawResult<Real, state_count> update(const LawInput<Real, state_count>& old) const
    {
        LawResult<Real, state_count> result;
        result.stress = elastic_stress(old.stress, old.strain_increment, bulk_modulus_, shear_modulus_);
        const SymmetricTensor<Real>& s = result.stress;
        const Real size =
            absolute(s.xx) + absolute(s.yy) + absolute(s.zz) + absolute(s.xy) + absolute(s.yz) + absolute(s.xz);
        const Mask<Real> usable = size <= Real(std::numeric_limits<double>::max());
        if (!all(usable)) {
            result.failed = !usable;
            result.reason = "stress or strain increment is not a finite number";
        }
        return result;
    }

    template <class Real>
    std::array<Real, state_count> initial_state(const LawInput<Real, state_count>&, double) const
    {
        return {};
    }

private:
    double bulk_modulus_;
    double shear_modulus_;
};

} // namespace periporo
