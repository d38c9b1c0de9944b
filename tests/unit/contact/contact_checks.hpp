// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// What every recoverable contact law must satisfy, evaluated through the interface.
#pragma once

#include "periporo/contact.hpp"
#include "periporo/kit/parameters.hpp"

#include <doctest/doctest.h>

#include <array>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace periporo::test {

/// A law with the defaults of its records and `given` in their place, scaled.
template <class Law>
Law made(const std::map<std::string, ParameterValue>& given, const ContactScale& scale)
{
    const Parameters parameters = kit::parameters_of(Law::parameters(), given);
    Law law(parameters);
    CHECK(kit::check_parameters(Law::parameters(), parameters) == kit::Faults{});
    law.scale(scale);
    return law;
}

inline ContactResponse response_at(const Contact& contact, double distance, ContactPair pair)
{
    pair.distance = distance;
    ContactResponse response;
    contact.evaluate({&pair, 1}, {&response, 1});
    return response;
}

/// The force is -dE/dd and the stiffness -dF/dd between two distances, and the energy changes by the work done there.
/// The law must be smooth between them; it may vanish as any power of the distance from `high`.
inline void check_section(const Contact& contact, const ContactPair& pair, double low, double high)
{
    CAPTURE(low);
    CAPTURE(high);
    const auto energy = [&](double d) { return response_at(contact, d, pair).energy; };
    const auto force = [&](double d) { return response_at(contact, d, pair).force; };
    const double h = 5e-4 * (high - low);
    // Differences of fourth order: exact for a parabola; for o^(5/2), at the last place with h = o/100, 2e-10.
    // Round-off is 1e-16 of the energy over 5e-4.
    const auto fall = [h](const auto& f, double d) {
        return (8.0 * (f(d - h) - f(d + h)) - (f(d - 2.0 * h) - f(d + 2.0 * h))) / (12.0 * h);
    };
    for (int n = 1; n < 20; ++n) {
        const double d = low + (high - low) * n / 20.0;
        const ContactResponse here = response_at(contact, d, pair);
        CHECK(here.force == doctest::Approx(fall(energy, d)).epsilon(1e-9).scale(0.0));
        CHECK(here.stiffness == doctest::Approx(fall(force, d)).epsilon(1e-9).scale(0.0));
    }
    // Simpson's rule over s with d = high - (high - low) s^2: exact for a line; for o^(3/2) = s^3, 1e-13.
    const int panels = 1000;
    double work = 0.0;
    for (int n = 0; n <= 2 * panels; ++n) {
        const double s = n / (2.0 * panels);
        const double weight = n == 0 || n == 2 * panels ? 1.0 : n % 2 == 1 ? 4.0 : 2.0;
        work += weight / (6.0 * panels) * force(high - (high - low) * s * s) * 2.0 * s * (high - low);
    }
    CHECK(energy(low) - energy(high) == doctest::Approx(work).epsilon(1e-11).scale(0.0));
}

/// No force, stiffness or energy at and beyond the cut-off, whatever the speed.
inline void check_reach(const Contact& contact, ContactPair pair)
{
    for (const double speed : {-10.0, 0.0, 10.0})
        for (const double distance : {contact.cutoff(), 1.001 * contact.cutoff(), 10.0 * contact.cutoff()}) {
            pair.approach_speed = speed;
            const ContactResponse response = response_at(contact, distance, pair);
            CHECK(response.force == 0.0);
            CHECK(response.stiffness == 0.0);
            CHECK(response.energy == 0.0);
            CHECK(response.damping_force == 0.0);
        }
}

/// The stable step is made for the stiffness at distance 0: it is the slope of the force, which nowhere falls or rises
/// more steeply, jumps included.
inline void check_steepest_at_zero(const Contact& contact, const ContactPair& pair)
{
    const double steepest = response_at(contact, 0.0, pair).stiffness;
    const double step = contact.cutoff() / 1000.0;
    for (int n = -1000; n < 1100; ++n) {
        const ContactResponse here = response_at(contact, n * step, pair);
        const ContactResponse next = response_at(contact, (n + 1) * step, pair);
        // 1e-12: round-off of forces of up to 2 cut-offs over one of 1000 steps
        CHECK(std::abs(here.force - next.force) <= steepest * step * (1.0 + 1e-12));
        CHECK(std::abs(here.stiffness) <= steepest * (1.0 + 1e-14));
    }
}

/// A block gives what its members give one by one.
inline void check_block(const Contact& contact, const ContactPair& pair)
{
    std::array<ContactPair, 7> pairs;
    std::array<ContactResponse, 7> responses;
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        pairs[i] = pair;
        pairs[i].distance = contact.cutoff() * 0.25 * static_cast<double>(i);
        pairs[i].volume_a *= 1.0 + static_cast<double>(i);
        pairs[i].approach_speed = 0.01 * static_cast<double>(i);
        responses[i] = {1.0, 1.0, 1.0, 1.0}; // to be overwritten
    }
    contact.evaluate(pairs, responses);
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        const ContactResponse single = response_at(contact, pairs[i].distance, pairs[i]);
        CHECK(responses[i].force == single.force);
        CHECK(responses[i].stiffness == single.stiffness);
        CHECK(responses[i].energy == single.energy);
        CHECK(responses[i].damping_force == single.damping_force);
    }
}

/// Two unequal points see the same force to the last bit, so that momentum is kept.
inline void check_both_ends(const Contact& contact, const ContactPair& pair)
{
    // Pairs lie in memory, as in the framework: the arithmetic that makes them must not be merged with that of the law.
    std::vector<ContactPair> from_a, from_b;
    for (int n = 1; n < 1000; ++n) {
        const double f = n / 1000.0;
        from_a.push_back(
            {f * contact.cutoff(), 0.1 * f, pair.volume_a, f * pair.volume_b, f * f * pair.mass_a, pair.mass_b});
        from_b.push_back(from_a.back());
        std::swap(from_b.back().volume_a, from_b.back().volume_b);
        std::swap(from_b.back().mass_a, from_b.back().mass_b);
    }
    std::vector<ContactResponse> on_a(from_a.size()), on_b(from_b.size());
    contact.evaluate(from_a, on_a);
    contact.evaluate(from_b, on_b);
    for (std::size_t n = 0; n < on_a.size(); ++n)
        CHECK(on_a[n].force == on_b[n].force);
}

} // namespace periporo::test
