// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// What every recoverable contact law must satisfy, evaluated through the interface.
#pragma once

#include "periporo/contact.hpp"

#include <doctest/doctest.h>

#include <array>

namespace periporo::test {

inline ContactResponse response_at(const Contact& contact, double distance, ContactPair pair)
{
    pair.distance = distance;
    ContactResponse response;
    contact.evaluate({&pair, 1}, {&response, 1});
    return response;
}

/// The force is -dE/dd and the stiffness -dF/dd at distances from `low` to the cut-off.
inline void check_derivatives(const Contact& contact, double low, const ContactPair& pair)
{
    const double high = contact.cutoff();
    for (int n = 1; n < 20; ++n) {
        const double distance = low + (high - low) * n / 20.0;
        const double h = 1e-3 * (high - low);
        const ContactResponse here = response_at(contact, distance, pair);
        const ContactResponse before = response_at(contact, distance - h, pair);
        const ContactResponse after = response_at(contact, distance + h, pair);
        // central differences of a quadratic and of a line are exact; what is left is round-off over the 1e-3 of h
        CHECK(here.force == doctest::Approx((before.energy - after.energy) / (2.0 * h)).epsilon(1e-10).scale(0.0));
        CHECK(here.stiffness == doctest::Approx((before.force - after.force) / (2.0 * h)).epsilon(1e-10).scale(0.0));
    }
}

/// The energy is the work done from the cut-off down to `low`.
inline void check_work(const Contact& contact, double low, const ContactPair& pair)
{
    const int steps = 100;
    const double length = (contact.cutoff() - low) / steps;
    double work = 0.0;
    for (int n = 0; n < steps; ++n) // the midpoint rule is exact for a line
        work += response_at(contact, low + (n + 0.5) * length, pair).force * length;
    CHECK(response_at(contact, low, pair).energy == doctest::Approx(work).epsilon(1e-12).scale(0.0));
}

/// No force, stiffness or energy at and beyond the cut-off.
inline void check_reach(const Contact& contact, const ContactPair& pair)
{
    for (const double distance : {contact.cutoff(), 1.001 * contact.cutoff(), 10.0 * contact.cutoff()}) {
        const ContactResponse response = response_at(contact, distance, pair);
        CHECK(response.force == 0.0);
        CHECK(response.stiffness == 0.0);
        CHECK(response.energy == 0.0);
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
        responses[i] = {1.0, 1.0, 1.0}; // to be overwritten
    }
    contact.evaluate(pairs, responses);
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        const ContactResponse single = response_at(contact, pairs[i].distance, pairs[i]);
        CHECK(responses[i].force == single.force);
        CHECK(responses[i].stiffness == single.stiffness);
        CHECK(responses[i].energy == single.energy);
    }
}

} // namespace periporo::test
