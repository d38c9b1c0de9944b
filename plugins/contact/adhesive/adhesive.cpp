// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The plugin contact "adhesive".
#include "adhesive.hpp"

PERIPORO_PLUGIN(periporo::PluginKind::contact, periporo::Adhesive, "adhesive",
                "Linear short-range repulsion with cohesion")
