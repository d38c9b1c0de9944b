// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Random numbers, tensors and rotations, the same in every run and on every machine.
#pragma once

#include "periporo/tensor.hpp"

#include <cmath>
#include <cstdint>
#include <random>

namespace periporo::kit {

class Random {
public:
    explicit Random(std::uint64_t seed = 20260101) : engine_(seed) {}

    /// In [-1, 1].
    double number() { return 2.0 * static_cast<double>(engine_() >> 11) * 0x1p-53 - 1.0; }
    double number(double low, double high) { return low + 0.5 * (number() + 1.0) * (high - low); }

    /// A symmetric tensor of any direction with the norm `size`.
    SymmetricTensor<double> tensor(double size)
    {
        SymmetricTensor<double> a{number(), number(), number(), number(), number(), number()};
        return a * (size / norm(a));
    }

    /// From the four components of a unit quaternion.
    Tensor<double> rotation()
    {
        double w = number(), x = number(), y = number(), z = number();
        const double length = std::sqrt(w * w + x * x + y * y + z * z);
        w /= length, x /= length, y /= length, z /= length;
        return {1 - 2 * (y * y + z * z), 2 * (x * y - w * z),     2 * (x * z + w * y),
                2 * (x * y + w * z),     1 - 2 * (x * x + z * z), 2 * (y * z - w * x),
                2 * (x * z - w * y),     2 * (y * z + w * x),     1 - 2 * (x * x + y * y)};
    }

private:
    std::mt19937_64 engine_;
};

} // namespace periporo::kit
