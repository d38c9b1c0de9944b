// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// What the tests of material laws share: parameters by name, and steps of a point that must succeed.
#pragma once

#include "periporo/kit/parameters.hpp"
#include "periporo/kit/random.hpp"
#include "periporo/material_law.hpp"
#include "periporo/material_point.hpp"

#include <array>
#include <map>
#include <stdexcept>
#include <vector>

namespace periporo::test {

using kit::Random;
using Stress = SymmetricTensor<double>;
using Strain = SymmetricTensor<double>;

/// The parameter values a law of numbers is built from: `given` over the defaults of its records, ranges checked.
inline Parameters parameter_values(const std::vector<Parameter>& records, const std::map<std::string, double>& given)
{
    return kit::parameters_of(records, {given.begin(), given.end()});
}

/// Advances a point. @throws std::runtime_error with what the law says when it gives up.
inline void step(MaterialPoint& point, const Strain& increment, double time_step = 1e-3)
{
    if (const MaterialStatus status = point.step(increment, time_step); !status.converged)
        throw std::runtime_error(status.reason);
}

/// A step of a drained triaxial test: axial strain along xx, the lateral stresses held to 1e-7 Pa.
inline void step_triaxial(MaterialPoint& point, double axial_strain, double time_step = 1e-3)
{
    const MixedStep mixed{{false, true, true, false, false, false}, {axial_strain, 0, 0, 0, 0, 0}, time_step, 1e-7};
    if (const MaterialStatus status = point.step(mixed); !status.converged)
        throw std::runtime_error(status.reason);
}

} // namespace periporo::test
