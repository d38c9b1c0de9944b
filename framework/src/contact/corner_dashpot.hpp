// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The dashpot of a contact law in a corner, where a point moves from face to face.
#pragma once

#include "contact/shortest_exit.hpp"
#include "periporo/contact.hpp"

namespace periporo {

/// The dashpot force on a point in contact with several faces, against its motion from face to face [N]: across the
/// exit, since the law damps the motion along it. No face is left with a pull.
/// @param pair as the law received it
/// @param velocity relative to the faces [m/s]
/// @param reaction along the exit [N]
Vector3 corner_dashpot(const Contact& law, ContactPair pair, const ShortestExit& exit, const Vector3& velocity,
                       const Vector3& reaction);

} // namespace periporo
