// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Checks a contact law by one call, in the test of its author.
//
//     #include <periporo/contact_kit.hpp>
//
//     const Parameters parameters = kit::parameters_of(MyLaw::parameters(), {{"stiffness", 1000.0}, ...});
//     for (const std::string& fault : kit::check_contact_law<MyLaw>(parameters, {.restitution = 0.5}))
//         std::cerr << fault << '\n';
//
// Each sentence describes one check that failed, with the value found and the value expected. A sound law has none.
// kit::ContactRange states the limits that the law claims. Each check is a function of its own in periporo/contact_kit.
#pragma once

#include "periporo/contact_kit/collision.hpp"
#include "periporo/contact_kit/forces.hpp"
#include "periporo/contact_kit/range.hpp"
#include "periporo/contact_kit/reach.hpp"
#include "periporo/contact_kit/surface.hpp"
#include "periporo/kit/parameters.hpp"

#include <string>
#include <utility>

namespace periporo::kit {

/// Makes every check of one partner that the framework's interface allows.
/// @param law scaled for this partner
inline Faults check_contact(const Contact& law, ContactPartner partner, const ContactRange& range = {})
{
    Faults faults = check_reach(law, partner, range);
    if (faults.empty())
        faults = check_finite(law, partner, range);
    if (!faults.empty())
        return faults; // the others build on these
    for (Faults (*check)(const Contact&, ContactPartner, const ContactRange&) :
         {check_blocks, check_stored_energy, check_damping, check_pull, check_collision})
        for (std::string& fault : check(law, partner, range))
            faults.push_back(std::move(fault));
    return faults;
}

/// check_contact() between points and at a rigid surface, the two compared, the surface of the law if it has one, and
/// that the constructor reads all parameters and no other. An exception of the constructor or of scale() is the
/// caller's.
template <class Law>
Faults check_contact_law(const Parameters& parameters, const ContactRange& range = {})
{
    Parameters own; // a copy, of which no value has been read yet
    for (const auto& [name, value] : parameters.values())
        own.set(name, value);
    Law between_points(own), at_surface(own);
    Faults faults = check_parameters(Law::parameters(), own);
    const auto add = [&](Faults found) {
        for (std::string& fault : found)
            faults.push_back(std::move(fault));
    };
    at_surface.scale({range.spacing, range.horizon, ContactPartner::surface});
    add(check_contact(at_surface, ContactPartner::surface, range));
    if (const RigidSurface* surface = at_surface.surface()) { // such a law never meets two points
        add(check_surface(*surface, range));
        return faults;
    }
    between_points.scale({range.spacing, range.horizon, ContactPartner::points});
    add(check_contact(between_points, ContactPartner::points, range));
    if (!faults.empty())
        return faults;
    add(check_symmetry(between_points, range));
    add(check_rigid_surface(between_points, at_surface, range));
    return faults;
}

} // namespace periporo::kit
