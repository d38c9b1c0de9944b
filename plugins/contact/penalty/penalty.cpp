// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The plugin contact "penalty".
#include "penalty.hpp"

PERIPORO_PLUGIN(periporo::PluginKind::contact, periporo::Penalty, "penalty",
                "Interface with a normal stiffness, stress per overlap")
