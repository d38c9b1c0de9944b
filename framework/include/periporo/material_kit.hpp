// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Checks a material law by one call, in the test of whoever wrote it.
//
//     #include <periporo/material_kit.hpp>
//
//     const Parameters parameters = kit::parameters_of(MyLaw::parameters(), {{"bulk_modulus", 25e6}, ...});
//     for (const std::string& fault : kit::check_law<MyLaw>(parameters))
//         std::cerr << fault << '\n';
//
// Each sentence tells of one check that failed, with what was found and what was expected; a sound law has none. What
// the checks need to know of a law stands in kit::Range. The checks are functions of their own, one header for each
// matter, in periporo/kit.
#pragma once

#include "periporo/kit/declarations.hpp"
#include "periporo/kit/dissipation.hpp"
#include "periporo/kit/elastic_loop.hpp"
#include "periporo/kit/hostile_input.hpp"
#include "periporo/kit/initial_state.hpp"
#include "periporo/kit/lanes.hpp"
#include "periporo/kit/memory.hpp"
#include "periporo/kit/objectivity.hpp"
#include "periporo/kit/packs_and_doubles.hpp"
#include "periporo/kit/parameters.hpp"
#include "periporo/kit/step_convergence.hpp"
#include "periporo/kit/stiffness.hpp"
#include "periporo/kit/tension.hpp"
#include "periporo/kit/unset.hpp"

#include <exception>

namespace periporo::kit {

namespace detail {

/// Appends what a check finds; an exception that leaves the material is a fault too.
template <class Check>
void collect(Faults& faults, Check&& check)
{
    try {
        for (std::string& fault : check())
            faults.push_back(std::move(fault));
    } catch (const std::exception& exception) {
        faults.push_back(std::string("the law throws, which it must not: ") + exception.what());
    } catch (...) {
        faults.emplace_back("the law throws, which it must not, and nothing derived from std::exception");
    }
}

} // namespace detail

/// Makes every check that the operator's interface allows, so also on a material of a loaded plugin.
inline Faults check_material(const Material& material, const Range& range = {})
{
    Faults faults;
    detail::collect(faults, [&] { return check_state_variables(material); });
    detail::collect(faults, [&] { return check_moduli(material); });
    if (!faults.empty())
        return faults; // the others build on these
    for (Faults (*check)(const Material&, const Range&) :
         {check_unset, check_initial_state, check_elastic_response, check_elastic_loop, check_objectivity,
          check_step_convergence, check_tension, check_dissipation, check_stiffness, check_restart, check_repetition,
          check_threads, check_lanes, check_inactive_lanes, check_huge_steps, check_not_finite_input,
          check_failure_names_bond})
        detail::collect(faults, [&] { return check(material, range); });
    return faults;
}

/// check_material on LawMaterial<Law>, that packs give what doubles give, and that the constructor reads all parameters
/// and no other. An exception of the constructor is the caller's.
template <class Law>
Faults check_law(const Parameters& parameters, const Range& range = {})
{
    const Parameters own = [&] { // whatever was read of the caller's does not count
        Parameters copy;
        for (const auto& [name, value] : parameters.values())
            copy.set(name, value);
        return copy;
    }();
    const LawMaterial<Law> material(own);
    Faults faults = check_parameters(Law::parameters(), own);
    detail::collect(faults, [&] { return check_material(material, range); });
    if (check_moduli(material).empty())
        detail::collect(faults, [&] { return check_packs(material.law(), material, range); });
    return faults;
}

} // namespace periporo::kit
