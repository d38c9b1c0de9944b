// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Contact of free grains: no energy appears where a point comes loose or bonds again.
#include "contact/contact_forces.hpp"
#include "contact/short_range/short_range.hpp"
#include "support/specimens.hpp"

#include <doctest/doctest.h>

using namespace periporo;

namespace {

const double spacing = 1e-2; // the law reaches 0.8 of it

/// Grains in a row.
struct Grains {
    explicit Grains(const std::vector<double>& places)
        : model(specimens::from_positions(positions(places), spacing)), contact({{short_range(), {0, 0}}})
    {
        find_first_families(model,
                            *make_force_state("energy_conjugate", Influence::by_name("constant", model.horizon)));
    }

    static std::vector<Vector3> positions(const std::vector<double>& places)
    {
        std::vector<Vector3> result;
        for (const double place : places)
            result.push_back({place * spacing, 0.0, 0.0});
        return result;
    }

    static std::shared_ptr<const Contact> short_range()
    {
        Parameters parameters;
        parameters.set("modulus", 4e6);
        parameters.set("friction", 0.0);
        parameters.set("restitution", 1.0);
        auto law = std::make_shared<ShortRange>(parameters);
        law->scale({spacing, 3.015 * spacing});
        return law;
    }

    /// Energy of the contacts of grains at `places` [spacings] of which those named are free [J].
    double energy(const std::vector<double>& places, const std::vector<std::uint8_t>& free)
    {
        model.points.position = positions(places);
        model.free_grain = free;
        model.update_records();
        std::vector<Vector3> force(model.size(), Vector3::Zero());
        contact.add_reactions(model, 1e-5, ContactForces::Approach::none, force);
        return contact.energy();
    }

    Model model;
    ContactForces contact;
};

} // namespace

TEST_CASE("a grain that comes loose takes the room it finds and no energy")
{
    Grains grains({0.0, 0.5, 1.0});
    CHECK(grains.energy({0.0, 0.5, 1.0}, {0, 0, 0}) == 0.0);
    CHECK(grains.energy({0.0, 0.5, 1.0}, {0, 1, 0}) == 0.0);
    CHECK(grains.energy({0.0, 0.4, 1.0}, {0, 1, 0}) > 0.0);
    // once apart, it fills the whole reach of the law
    CHECK(grains.energy({-1.0, 0.4, 2.0}, {0, 1, 0}) == 0.0);
    CHECK(grains.energy({-0.3, 0.4, 2.0}, {0, 1, 0}) > 0.0);
}

TEST_CASE("a grain that bonds again keeps its reach against other grains until they part")
{
    Grains grains({0.0, 0.8, 1.3});
    // the first grain has the whole reach, the second that of the third beside it
    CHECK(grains.energy({0.0, 0.8, 1.3}, {1, 1, 1}) == 0.0);
    CHECK(grains.energy({0.15, 0.8, 1.3}, {1, 1, 1}) == 0.0);
    CHECK(grains.energy({0.15, 0.8, 1.3}, {1, 0, 0}) == 0.0);
    CHECK(grains.energy({0.15, 0.8, 1.3}, {1, 1, 0}) == 0.0);
    CHECK(grains.energy({0.15, 0.8, 1.3}, {1, 0, 0}) == 0.0);
    CHECK(grains.energy({0.0, 0.8, 1.6}, {1, 0, 0}) == 0.0);
    CHECK(grains.energy({0.15, 0.8, 1.6}, {1, 0, 0}) > 0.0);
}
