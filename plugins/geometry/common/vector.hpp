// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Vectors out of parameters.
#pragma once

#include "periporo/parameters.hpp"
#include "periporo/tensor.hpp"

#include <stdexcept>
#include <string>

namespace periporo::geometry {

inline Vector3 vector(const Parameters& parameters, const std::string& name)
{
    const std::vector<double>& list = parameters.real_list(name);
    return {list.at(0), list.at(1), list.at(2)};
}

/// A direction of any length.
/// @throws std::runtime_error when it is zero.
inline Vector3 direction(const Parameters& parameters, const std::string& name)
{
    Vector3 value = vector(parameters, name);
    if (value.isZero(0.0))
        throw std::runtime_error(name + " must not be zero");
    return value;
}

} // namespace periporo::geometry
