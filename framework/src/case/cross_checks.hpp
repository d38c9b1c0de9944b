// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// What no single table of a case can tell: whether its parts fit together.
#pragma once

#include "case/checker.hpp"

namespace periporo {

/// Reports names that lead nowhere, stages of one name, water that contradicts itself and the like.
void check_together(const CheckedTable& root, Diagnostics& diagnostics);

/// Makes every plugin object of a case once: what a plugin refuses in its constructor is an error of the case, at the
/// table that chose the plugin. Only for a case without other errors.
void try_plugins(const CheckedTable& root, const PluginRegistry& registry, Diagnostics& diagnostics);

/// Makes every contact law of a case once more, in its place: what it cannot do there, or does not do there, is an
/// error of the case. Laws that their plugin refuses are left to try_plugins(). Only for a case without other errors.
void try_contacts(const CheckedTable& root, const PluginRegistry& registry, Diagnostics& diagnostics);

} // namespace periporo
