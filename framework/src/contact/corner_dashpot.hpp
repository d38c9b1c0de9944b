// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The dashpot of a contact law in a corner, where a point moves from face to face.
#pragma once

#include "contact/way_out.hpp"
#include "periporo/contact.hpp"

namespace periporo {

/// The dashpot force on a point that several faces hold, against its motion from face to face [N]: across the way out,
/// along which the law has damped it already. It leaves no face with a pull.
/// @param pair as the law had it
/// @param velocity relative to the faces [m/s]
/// @param reaction along the way out [N]
Vector3 brake_across(const Contact& law, ContactPair pair, const WayOut& way, const Vector3& velocity,
                     const Vector3& reaction);

} // namespace periporo
