// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Vectors in space.
#pragma once

#include "periporo/target.hpp"

#include <Eigen/Core>

namespace periporo {

/// A point, displacement, velocity or force in space [SI units].
using Vector3 = Eigen::Vector3d;

static_assert(EIGEN_MAX_ALIGN_BYTES == eigen_alignment,
              "a macro sets Eigen to another alignment than the program has; a plugin must leave it as it is");

} // namespace periporo
