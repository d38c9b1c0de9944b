// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The plugin contact "rigid_plane".
#include "rigid_plane.hpp"

PERIPORO_PLUGIN(periporo::PluginKind::contact, periporo::RigidPlane, "rigid_plane",
                "Fixed rigid plane with a linear reaction")
