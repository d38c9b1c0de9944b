// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The part of a material law that an update uses.
#pragma once

namespace periporo {

enum class MaterialResponse {
    full,   ///< the law itself
    elastic ///< its isotropic elastic part only, state unchanged: for settling under gravity
};

} // namespace periporo
