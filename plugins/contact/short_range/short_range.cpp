// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The plugin contact "short_range".
#include "short_range.hpp"

PERIPORO_PLUGIN(periporo::PluginKind::contact, periporo::ShortRange, "short_range", "Linear short-range repulsion")
