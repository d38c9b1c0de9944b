// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Interface of material plugins as the operator calls it, one call for a block of bonds. Authors write a law for one
// point (material_law.hpp) and never meet this.
#pragma once

#include "periporo/material_response.hpp"
#include "periporo/plugin.hpp"

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

namespace periporo {

/// One internal variable of a law, carried by every bond, handed over when bonds are born and written to the results.
/// The mean of two values must be meaningful: a law keeps ln p_c, not p_c.
struct StateVariable {
    std::string name;
    std::string unit;
    std::string description;
    double initial = 0.0;
    bool reset_on_release = false; ///< back to `initial` after the geostatic stage, as accumulated strains are
    /// A property of the place and not of a direction, as density is: the bonds of a point start from its one value
    /// whenever families are found anew, and hand their mean change back to it.
    bool of_point = false;
};

/// A block of bonds for one update. A bond's data are rows of pack_width doubles: six of effective stress
/// (tension-positive, xx yy zz xy yz xz), then one for each state variable; blocks of rows follow each other.
struct MaterialBatch {
    std::size_t packs = 0;
    double* bonds = nullptr;                  ///< packs x (6 + state variables) x pack_width; stress already rotated
    const double* strain_increment = nullptr; ///< packs x 6 x pack_width, D dt [-]
    const double* suction = nullptr;          ///< packs x pack_width, s >= 0 [Pa]
    const double* saturation = nullptr;       ///< packs x pack_width, S_r [-]
    const std::uint8_t* active = nullptr;     ///< packs, bit l set when lane l is a bond that carries stress
    double time_step = 0.0;                   ///< [s]
    MaterialResponse response = MaterialResponse::full;
};

/// The outcome of a block.
struct MaterialStatus {
    bool converged = true;
    std::size_t bond = 0;         ///< index in the block of the first bond that failed
    const char* reason = nullptr; ///< static text
};

class Material {
public:
    virtual ~Material() = default;

    virtual const std::vector<StateVariable>& state_variables() const = 0;
    /// Elastic moduli K and G [Pa] that bound the stiffness of the law, for the stable step. Flow that is not along the
    /// normal of the yield surface may exceed them by some per cent; the safety factor of the step covers a wave
    /// modulus K + 4/3 G larger by 38 per cent.
    virtual double bulk_modulus() const = 0;
    virtual double shear_modulus() const = 0;
    /// Do surfaces that came apart, or never were one, become one piece when they have come to rest against each other?
    /// Soil does: its grains remember no surface. A solid does not: such surfaces keep touching by contact.
    virtual bool closes() const { return true; }
    /// Advances stress and state of a block by one step. Does not throw.
    virtual MaterialStatus update(const MaterialBatch& batch) const = 0;
    /// Sets the state variables of a block from its settled effective stress and the overconsolidation ratio.
    /// `strain_increment` and `time_step` are not read.
    virtual void initialize(const MaterialBatch& batch, double overconsolidation_ratio) const = 0;
};

/// Makes of a settled block what the geostatic stage leaves: Material::initialize(), then the variables that are reset
/// on release back to their initial values.
inline void release(const Material& material, const MaterialBatch& batch, double overconsolidation_ratio)
{
    material.initialize(batch, overconsolidation_ratio);
    const std::vector<StateVariable>& variables = material.state_variables();
    const std::size_t rows = 6 + variables.size();
    for (std::size_t s = 0; s < variables.size(); ++s)
        if (variables[s].reset_on_release)
            for (std::size_t p = 0; p < batch.packs; ++p)
                std::fill_n(batch.bonds + (p * rows + 6 + s) * pack_width, pack_width, variables[s].initial);
}

} // namespace periporo
