// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The plugin material "mohr_coulomb".
#include "mohr_coulomb.hpp"

PERIPORO_PLUGIN(periporo::PluginKind::material, periporo::LawMaterial<periporo::MohrCoulomb>, "mohr_coulomb",
                "Friction, cohesion and dilatancy by the hexagonal pyramid with exact corners, for a mass that carries "
                "nothing while it is apart")
