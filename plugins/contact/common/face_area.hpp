// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The area that the stress of a contact acts on.
#pragma once

#include "periporo/contact.hpp"

namespace periporo {

/// V_a^(2/3), the face of the point's cell; between two points that of the smaller one [m2].
inline double face_area(const ContactPair& pair, ContactPartner partner)
{
    const double volume = partner == ContactPartner::points ? std::min(pair.volume_a, pair.volume_b) : pair.volume_a;
    const double edge = std::cbrt(volume);
    return edge * edge;
}

} // namespace periporo
