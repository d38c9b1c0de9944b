// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The plugin material "mu_i_rheology".
#include "mu_i_rheology.hpp"

PERIPORO_PLUGIN(periporo::PluginKind::material, periporo::LawMaterial<periporo::MuIRheology>, "mu_i_rheology",
                "Dense granular flow: friction by the inertial number, mu(I), that carries nothing while it is apart")
