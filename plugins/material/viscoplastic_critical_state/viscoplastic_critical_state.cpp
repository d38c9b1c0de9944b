// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The plugin material "viscoplastic_critical_state".
#include "viscoplastic_critical_state.hpp"

PERIPORO_PLUGIN(
    periporo::PluginKind::material, periporo::LawMaterial<periporo::ViscoplasticCriticalState>,
    "viscoplastic_critical_state",
    "Viscoplastic critical-state model for dry and unsaturated soil (modified Cam-clay ellipse, Perzyna flow)")
