// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Faults in what a material tells the operator, put over a sound law.
#include "little_laws.hpp"
#include "support/errors.hpp"

#include <doctest/doctest.h>

#include <stdexcept>

using namespace periporo;
using namespace periporo::test;

namespace {

struct NegativeModulus : LittleMaterial {
    double shear_modulus() const override { return -15e6; }
};

struct WaveringModulus : LittleMaterial {
    double bulk_modulus() const override { return modulus_ += 1.0; }
    mutable double modulus_ = 25e6;
};

struct BadlyNamed : LittleMaterial {
    const std::vector<StateVariable>& state_variables() const override { return variables; }
    std::vector<StateVariable> variables = {{"friction", "-", "Stress ratio"}, {"friction", "", "Plastic strain"}};
};

struct MovingElastic : LittleMaterial {
    MaterialStatus update(const MaterialBatch& batch) const override
    {
        if (batch.response == MaterialResponse::elastic)
            batch.bonds[7 * pack_width] += 1e-6; // shear strain of the first lane
        return LawMaterial::update(batch);
    }
};

struct WrongBond : LittleMaterial {
    MaterialStatus update(const MaterialBatch& batch) const override
    {
        MaterialStatus status = LawMaterial::update(batch);
        if (batch.packs > 1)
            status.bond = 0;
        return status;
    }
};

struct Throwing : LittleMaterial {
    MaterialStatus update(const MaterialBatch& batch) const override
    {
        if (batch.time_step == 0.0)
            throw std::domain_error("no time");
        return LawMaterial::update(batch);
    }
};

struct Settling : LittleMaterial {
    void initialize(const MaterialBatch& batch, double overconsolidation_ratio) const override
    {
        LawMaterial::initialize(batch, overconsolidation_ratio);
        batch.bonds[0] *= 0.5;
    }
};

struct EndlessState : LittleMaterial {
    void initialize(const MaterialBatch& batch, double overconsolidation_ratio) const override
    {
        LawMaterial::initialize(batch, overconsolidation_ratio);
        batch.bonds[6 * pack_width] = -std::log(std::abs(batch.bonds[0]));
    }
};

} // namespace

TEST_CASE("a modulus that is not positive is named with its value")
{
    check_mentions(sentence_of("moduli", kit::check_material(NegativeModulus())), {"shear", "-15000000 Pa"});
}

TEST_CASE("a modulus that changes is named")
{
    check_mentions(sentence_of("moduli", kit::check_material(WaveringModulus())), {"bulk", "and then"});
}

TEST_CASE("a name used twice and a missing unit are told")
{
    const std::vector<std::string> faults = kit::check_material(BadlyNamed());
    REQUIRE(faults.size() == 2);
    check_mentions(faults[0], {"state variables:", "friction", "twice"});
    check_mentions(faults[1], {"state variables:", "friction", "no unit"});
}

TEST_CASE("an elastic response that touches the state is found")
{
    check_mentions(sentence_of("elastic response", kit::check_material(MovingElastic())),
                   {"state variable shear_strain", "off by"});
}

TEST_CASE("a failure reported for another bond is found")
{
    check_mentions(sentence_of("failure", kit::check_material(WrongBond())), {"reported as a failure of bond 0"});
}

TEST_CASE("an exception out of a call is a fault and ends no other check")
{
    const std::vector<std::string> faults = kit::check_material(Throwing());
    REQUIRE(faults.size() == 1);
    check_mentions(faults[0], {"throws", "no time"});
}

TEST_CASE("an initialize that changes the stress is found")
{
    check_mentions(sentence_of("initial state", kit::check_material(Settling())), {"changes the stress"});
}

TEST_CASE("an initial state that is not finite without stress is found")
{
    check_mentions(sentence_of("initial state", kit::check_material(EndlessState())), {"friction is inf"});
}
