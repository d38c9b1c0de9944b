// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Decides whether a plugin descriptor was made for this very program, before anything of it is called.
#pragma once

#include "periporo/plugin.hpp"

#include <string>

namespace periporo {

/// Why the descriptor cannot be used, expected against found; empty when it can. Reads no member before the ones that
/// vouch for it have been checked.
std::string descriptor_objection(const PluginDescriptor* descriptor);

} // namespace periporo
