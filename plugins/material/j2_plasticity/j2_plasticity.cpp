// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The plugin material "j2_plasticity".
#include "j2_plasticity.hpp"

PERIPORO_PLUGIN(periporo::PluginKind::material, periporo::LawMaterial<periporo::J2Plasticity>, "j2_plasticity",
                "Von Mises plasticity with isotropic hardening or softening, and Bingham viscosity")
