// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// What a material law is checked over: stresses, strains, times, water, and the limits the law claims for itself.
#pragma once

#include <string>
#include <vector>

namespace periporo::kit {

/// Sentences about checks that failed; none when all is sound.
using Faults = std::vector<std::string>;

/// The defaults suit soils that carry 1 to 100 kPa.
struct Range {
    /// Mean effective pressures of the states that paths start from, compression positive [Pa].
    std::vector<double> pressures = {1e3, 1e4, 1e5};
    /// The largest q/p of those states [-]: well inside any yield surface of the law.
    double stress_ratio = 0.3;
    /// OCR that `Material::initialize` is called with [-].
    double overconsolidation_ratio = 1.25;
    /// Sizes |D dt| of ordinary strain increments [-].
    std::vector<double> strain_increments = {1e-6, 1e-5, 1e-4, 1e-3};
    double time_step = 1e-4; ///< of every step [s]
    double suction = 0.0;    ///< s >= 0 of every point [Pa]
    double saturation = 0.0; ///< S_r of every point [-]
    double call_limit = 1.0; ///< processor time that one call may take [s]

    /// The largest mean tension that the law bears in any motion of this range [Pa], infinity for a metal. The
    /// overstress of a viscous law at 1e-3 of strain in a time step counts.
    double tension_limit = 0.0;
    /// Whether time itself changes the stress, by overstress or relaxation; then a stress may lie outside the yield
    /// surface for a while.
    bool rate_dependent = false;
    /// Whether hardening stores energy, as a back stress does; what is dissipated cannot then be seen from outside.
    bool stores_energy = false;
    /// What the law's own iterations leave open, relative to the stresses met in the step [-].
    double accuracy = 1e-9;
};

} // namespace periporo::kit
