// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The plugin material "drucker_prager".
#include "drucker_prager.hpp"

PERIPORO_PLUGIN(
    periporo::PluginKind::material, periporo::LawMaterial<periporo::DruckerPrager>, "drucker_prager",
    "Friction, cohesion and dilatancy by a circular cone, for a mass that carries nothing while it is apart")
