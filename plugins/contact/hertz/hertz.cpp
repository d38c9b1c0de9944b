// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The plugin contact "hertz".
#include "hertz.hpp"

PERIPORO_PLUGIN(periporo::PluginKind::contact, periporo::Hertz, "hertz", "Elastic spheres after Hertz")
