// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// What a material says of itself: moduli and state variables.
#pragma once

#include "periporo/kit/range.hpp"
#include "periporo/kit/text.hpp"
#include "periporo/material.hpp"

#include <cmath>
#include <set>

namespace periporo::kit {

/// The moduli are positive and finite, and the same whenever they are asked for.
inline Faults check_moduli(const Material& material)
{
    Faults faults;
    const auto check = [&](const char* name, double modulus, double again) {
        if (!(modulus > 0.0) || !std::isfinite(modulus))
            faults.push_back(sentence("moduli: the ", name, " modulus is ", modulus, " Pa, not positive and finite"));
        else if (modulus != again)
            faults.push_back(sentence("moduli: the ", name, " modulus is ", modulus, " Pa and then ", again, " Pa"));
    };
    check("bulk", material.bulk_modulus(), material.bulk_modulus());
    check("shear", material.shear_modulus(), material.shear_modulus());
    return faults;
}

/// State variables have unique names, units, descriptions and finite initial values, the same whenever they are asked
/// for.
inline Faults check_state_variables(const Material& material)
{
    Faults faults;
    const std::vector<StateVariable> variables = material.state_variables();
    const std::vector<StateVariable> again = material.state_variables();
    if (again.size() != variables.size())
        return {sentence("state variables: there are ", variables.size(), " and then ", again.size())};
    std::set<std::string> names;
    for (std::size_t s = 0; s < variables.size(); ++s) {
        const StateVariable& variable = variables[s];
        if (variable.name != again[s].name)
            faults.push_back(
                sentence("state variables: number ", s, " is named ", variable.name, " and then ", again[s].name));
        if (variable.name.empty())
            faults.push_back(sentence("state variables: number ", s, " has no name"));
        else if (!names.insert(variable.name).second)
            faults.push_back("state variables: the name " + variable.name + " is used twice");
        if (variable.unit.empty())
            faults.push_back("state variables: " + variable.name + " has no unit; a pure number has \"-\"");
        if (variable.description.empty())
            faults.push_back("state variables: " + variable.name + " has no description");
        if (!std::isfinite(variable.initial))
            faults.push_back(sentence("state variables: ", variable.name, " begins at ", variable.initial));
    }
    return faults;
}

} // namespace periporo::kit
