// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The plugin material "linear_elastic".
#include "linear_elastic.hpp"

PERIPORO_PLUGIN(periporo::PluginKind::material, periporo::LawMaterial<periporo::LinearElastic>, "linear_elastic",
                "Isotropic linear elasticity in rate form")
