// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The parameters that contact laws with a spring and a dashpot have in common.
#pragma once

#include "periporo/contact.hpp"

#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace periporo {

/// A spring, given as stiffness or as modulus, its reach, friction and restitution.
struct SpringParameters {
    std::optional<double> stiffness; ///< [N/m]; or
    double modulus = 0.0;            ///< C [Pa]
    std::optional<double> cutoff;    ///< d_c [m]
    double friction;                 ///< [-]
    double ratio;                    ///< of damping [-]

    /// @param rule how the stiffness follows from the modulus, "k = C spacing"
    /// @param default_cutoff in words
    static void append_records(std::vector<Parameter>& records, const std::string& rule,
                               const std::string& default_cutoff)
    {
        records.push_back(Parameter::real("stiffness", dimension::spring, "Spring of one contact; this or `modulus`")
                              .above(0.0)
                              .optional());
        records.push_back(
            Parameter::real("modulus", dimension::pressure, "Contact modulus C, " + rule + "; this or `stiffness`")
                .above(0.0)
                .optional());
        records.push_back(
            Parameter::real("cutoff", dimension::length, "Reach of the reaction; " + default_cutoff + " when left out")
                .above(0.0)
                .optional());
        records.push_back(
            Parameter::real("friction", dimension::none, "Coulomb coefficient of friction").at_least(0.0));
        records.push_back(Parameter::real("restitution", dimension::none,
                                          "Coefficient of restitution of a collision; 1 for an elastic one")
                              .at_least(0.0)
                              .at_most(1.0)
                              .by_default(1.0));
    }

    /// @throws std::invalid_argument unless exactly one of stiffness and modulus is given.
    explicit SpringParameters(const Parameters& parameters)
        : friction(parameters.real("friction")), ratio(damping_ratio(parameters.real("restitution")))
    {
        if (parameters.has("stiffness") == parameters.has("modulus"))
            throw std::invalid_argument("give exactly one of stiffness (N/m) and modulus (Pa)");
        if (parameters.has("stiffness"))
            stiffness = parameters.real("stiffness");
        else
            modulus = parameters.real("modulus");
        if (parameters.has("cutoff"))
            cutoff = parameters.real("cutoff");
    }
};

} // namespace periporo
