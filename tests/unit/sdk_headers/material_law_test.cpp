// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The adapter that runs a point law on blocks of bonds.
#include "periporo/material_law.hpp"

#include <doctest/doctest.h>

#include <string>

using namespace periporo;

namespace {

// Hooke's law that counts its steps, remembers its suction, and fails where the first strain component is above 1.
struct CountingLaw {
    static constexpr std::size_t state_count = 2;

    static std::vector<Parameter> parameters() { return {}; }
    static std::vector<StateVariable> state_variables()
    {
        return {{"steps", "-", "Steps taken", 0.0, true},
                {"last_suction", "Pa", "Suction of the last step", 0.0, false}};
    }
    explicit CountingLaw(const Parameters&) {}
    double bulk_modulus() const { return 3000.0; }
    double shear_modulus() const { return 1000.0; }

    template <class Real>
    LawResult<Real, 2> update(const LawInput<Real, 2>& old) const
    {
        LawResult<Real, 2> result;
        result.stress = elastic_stress(old.stress, old.strain_increment, bulk_modulus(), shear_modulus());
        result.stress.xy += Real(old.time_step); // so that the test sees which response ran
        result.state = {old.state[0] + 1.0, old.suction + old.saturation};
        result.failed = old.strain_increment.xx > Real(1.0);
        if (any(result.failed))
            result.reason = "too much for a counter";
        return result;
    }

    template <class Real>
    std::array<Real, 2> initial_state(const LawInput<Real, 2>& settled, double ratio) const
    {
        return {settled.stress.zz * ratio, settled.suction};
    }
};

using Adapter = LawMaterial<CountingLaw>;
constexpr std::size_t rows = 8;
constexpr std::size_t packs = 3;
constexpr std::size_t row_width = pack_width;
constexpr std::uint8_t every_lane = static_cast<std::uint8_t>((1u << pack_width) - 1u);

// A block whose every number is different; `bond(p, r, l)` and the like are its parts.
struct Block {
    alignas(64) std::array<double, packs * rows * row_width> bonds;
    alignas(64) std::array<double, packs * 6 * row_width> strains;
    alignas(64) std::array<double, packs * row_width> suction;
    alignas(64) std::array<double, packs * row_width> saturation;
    std::array<std::uint8_t, packs> active;

    Block()
    {
        for (std::size_t i = 0; i < bonds.size(); ++i)
            bonds[i] = 1.0 + static_cast<double>(i);
        for (std::size_t i = 0; i < strains.size(); ++i)
            strains[i] = 1e-3 * static_cast<double>(i % 37);
        for (std::size_t i = 0; i < suction.size(); ++i) {
            suction[i] = 100.0 + static_cast<double>(i);
            saturation[i] = 0.5;
        }
        active.fill(every_lane);
    }

    double& bond(std::size_t p, std::size_t row, std::size_t lane)
    {
        return bonds[(p * rows + row) * row_width + lane];
    }
    double& strain(std::size_t p, std::size_t row, std::size_t lane)
    {
        return strains[(p * 6 + row) * row_width + lane];
    }

    MaterialBatch batch()
    {
        MaterialBatch batch;
        batch.packs = packs;
        batch.bonds = bonds.data();
        batch.strain_increment = strains.data();
        batch.suction = suction.data();
        batch.saturation = saturation.data();
        batch.active = active.data();
        batch.time_step = 0.25;
        return batch;
    }
};

} // namespace

TEST_CASE("every bond of a block gets its own stress and state")
{
    const Adapter material{Parameters{}};
    Block block;
    Block before;
    CHECK(material.update(block.batch()).converged);
    for (std::size_t p = 0; p < packs; ++p)
        for (std::size_t lane = 0; lane < pack_width; ++lane) {
            double volumetric = 0.0;
            for (std::size_t c = 0; c < 3; ++c)
                volumetric += before.strain(p, c, lane);
            for (std::size_t c = 0; c < 6; ++c) {
                // K - 2 G/3 on the trace and 2 G on each component, and the time step that this law adds to xy
                const double expected = before.bond(p, c, lane) + 2000.0 * before.strain(p, c, lane) +
                                        (c < 3 ? (3000.0 - 2000.0 / 3.0) * volumetric : 0.0) + (c == 3 ? 0.25 : 0.0);
                CHECK(block.bond(p, c, lane) == doctest::Approx(expected).epsilon(1e-14));
            }
            CHECK(block.bond(p, 6, lane) == before.bond(p, 6, lane) + 1.0);
            CHECK(block.bond(p, 7, lane) == before.suction[p * pack_width + lane] + 0.5);
        }
}

TEST_CASE("the elastic response changes the stress by Hooke's law and leaves the state")
{
    const Adapter material{Parameters{}};
    Block block;
    Block before;
    MaterialBatch batch = block.batch();
    batch.response = MaterialResponse::elastic;
    CHECK(material.update(batch).converged);
    for (std::size_t lane = 0; lane < pack_width; ++lane) {
        CHECK(block.bond(1, 3, lane) ==
              doctest::Approx(before.bond(1, 3, lane) + 2000.0 * before.strain(1, 3, lane)).epsilon(1e-14));
        CHECK(block.bond(1, 6, lane) == before.bond(1, 6, lane));
        CHECK(block.bond(1, 7, lane) == before.bond(1, 7, lane));
    }
}

TEST_CASE("a pack without an active lane is left alone")
{
    const Adapter material{Parameters{}};
    Block block;
    Block before;
    block.active[1] = 0;
    block.strain(1, 0, 0) = 2.0; // would fail
    CHECK(material.update(block.batch()).converged);
    for (std::size_t row = 0; row < rows; ++row)
        for (std::size_t lane = 0; lane < pack_width; ++lane)
            CHECK(block.bond(1, row, lane) == before.bond(1, row, lane));
    CHECK(block.bond(2, 6, 0) == before.bond(2, 6, 0) + 1.0);
}

TEST_CASE("the first bond that fails is named, with the law's reason")
{
    const Adapter material{Parameters{}};
    Block block;
    const std::size_t lane = pack_width - 1;
    block.strain(1, 0, lane) = 2.0;
    block.strain(2, 0, 0) = 2.0;
    const MaterialStatus status = material.update(block.batch());
    CHECK_FALSE(status.converged);
    CHECK(status.bond == pack_width + lane);
    CHECK(std::string(status.reason) == "too much for a counter");
}

TEST_CASE("a failure in a lane that carries no bond is no failure")
{
    const Adapter material{Parameters{}};
    Block block;
    block.strain(1, 0, 0) = 2.0;
    block.active[1] = static_cast<std::uint8_t>(every_lane & ~1u);
    CHECK(material.update(block.batch()).converged);
}

TEST_CASE("initialize sets the state from the settled stress and leaves the stress")
{
    const Adapter material{Parameters{}};
    Block block;
    Block before;
    material.initialize(block.batch(), 1.25);
    for (std::size_t p = 0; p < packs; ++p)
        for (std::size_t lane = 0; lane < pack_width; ++lane) {
            for (std::size_t c = 0; c < 6; ++c)
                CHECK(block.bond(p, c, lane) == before.bond(p, c, lane));
            CHECK(block.bond(p, 6, lane) == 1.25 * before.bond(p, 2, lane));
            CHECK(block.bond(p, 7, lane) == before.suction[p * pack_width + lane]);
        }
}

TEST_CASE("the adapter hands on what the law says of itself")
{
    const Adapter material{Parameters{}};
    CHECK(material.bulk_modulus() == 3000.0);
    CHECK(material.shear_modulus() == 1000.0);
    REQUIRE(material.state_variables().size() == 2);
    CHECK(material.state_variables()[1].name == "last_suction");
}
