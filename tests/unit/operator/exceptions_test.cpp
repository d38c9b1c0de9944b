// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// What is thrown within parallel loops arrives outside of them, the same for any number of threads.
#include "assembly/body_fill.hpp"
#include "operator/block_loop.hpp"
#include "support/specimens.hpp"

#include <doctest/doctest.h>
#include <omp.h>

#include <new>
#include <stdexcept>
#include <string>

using namespace periporo;

namespace {

/// Throws for every batch whose first bond has been strained.
class Thrower : public LawMaterial<specimens::Hooke> {
public:
    using LawMaterial::LawMaterial;
    MaterialStatus update(const MaterialBatch&) const override { throw std::runtime_error("the law has thrown"); }
    double bulk_modulus() const override
    {
        if (modulus_throws)
            throw std::runtime_error("the modulus has thrown");
        return LawMaterial::bulk_modulus();
    }
    bool modulus_throws = false;
};

/// A cube of 100 mm in which one corner cannot be told from the outside.
class Doubtful : public Geometry {
public:
    bool contains(const Vector3& x) const override
    {
        if ((x.array() > 0.08).all())
            throw std::runtime_error("the geometry has thrown");
        return (x.array() >= 0.0).all() && (x.array() <= 0.1).all();
    }
    Bounds bounds() const override { return {Vector3::Zero(), Vector3::Constant(0.1)}; }
    double volume() const override { return 1e-3; }
    PointCloud fill(double) const override
    {
        return {specimens::lattice(8, 8, 8, 0.01), std::vector<double>(512, 1e-6)};
    }
};

Model block()
{
    return specimens::from_positions(specimens::lattice(10, 10, 10, 0.01), 0.01);
}

void with_threads(const std::function<void()>& check)
{
    for (const int threads : {1, 2, 3}) {
        CAPTURE(threads);
        omp_set_num_threads(threads);
        check();
    }
}

} // namespace

TEST_CASE("of the blocks of an evaluation that throw, the first one is heard")
{
    Model model = block();
    const auto force_state = make_force_state("energy_conjugate", Influence::by_name("linear", model.state.horizon));
    find_first_families(model, *force_state);
    REQUIRE(model.neighbourhood.blocks.blocks() > 5);
    with_threads([&] {
        CHECK_THROWS_WITH(for_every_block(model.neighbourhood.blocks, model.result.times,
                                          [](std::size_t n, OperatorTimes&) {
                                              if (n >= 3)
                                                  throw std::runtime_error(std::to_string(n));
                                          }),
                          "3");
    });
}

TEST_CASE("a law that throws, and a modulus that does, reach the caller from every force state")
{
    for (const std::string& name : force_state_names()) {
        CAPTURE(name);
        Model model = block();
        const auto law = std::make_shared<Thrower>(Parameters{});
        model.state.bodies[0].material = law;
        const auto force_state = make_force_state(name, Influence::by_name("linear", model.state.horizon));
        find_first_families(model, *force_state);
        with_threads([&] {
            law->modulus_throws = false;
            CHECK_THROWS_WITH(force_state->evaluate(model, {StressUpdate::advance, MaterialResponse::full, 1e-5}),
                              "the law has thrown");
            law->modulus_throws = true;
            CHECK_THROWS_WITH(force_state->evaluate(model, {StressUpdate::advance, MaterialResponse::full, 1e-5}),
                              "the modulus has thrown");
        });
    }
}

TEST_CASE("a geometry that throws while points are moved in it reaches the caller")
{
    for (const FillKind kind : {FillKind::jittered, FillKind::relaxed}) {
        FillDescription fill;
        fill.kind = kind;
        with_threads([&] { CHECK_THROWS_WITH(fill_body(Doubtful(), 0.01, fill), "the geometry has thrown"); });
    }
}

TEST_CASE("a lack of memory in a parallel loop stays a lack of memory")
{
    Model model = block();
    const auto force_state = make_force_state("bond_projection", Influence::by_name("linear", model.state.horizon));
    find_first_families(model, *force_state);
    CHECK_THROWS_AS(for_every_block(model.neighbourhood.blocks, model.result.times,
                                    [](std::size_t, OperatorTimes&) { throw std::bad_alloc(); }),
                    std::bad_alloc);
}
