// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Every fault of a law is found by the check that is for it, and a sound law passes all.
#include "little_laws.hpp"
#include "support/errors.hpp"

#include <doctest/doctest.h>

using namespace periporo;
using namespace periporo::test;

namespace {

/// What the check of this name says of a law with this fault, through the one call.
template <Fault fault>
std::string said_by(const std::string& check, const kit::Range& range = {})
{
    const LawMaterial<LittleLaw<fault>> material{little_parameters<fault>()};
    return sentence_of(check, kit::check_material(material, range));
}

} // namespace

TEST_CASE("a sound law has no faults")
{
    for (const std::string& fault : kit::check_law<LittleLaw<Fault::none>>(little_parameters<Fault::none>()))
        FAIL_CHECK(fault);
}

TEST_CASE("a value that a law forgets to set is noticed, of the initial state and of an update")
{
    check_mentions(said_by<Fault::unset_initial_state>("unset values"), {"initialize", "shear_strain"});
    check_mentions(said_by<Fault::unset_state>("unset values"), {"update", "shear_strain"});
}

TEST_CASE("a law that miscounts its state variables is refused")
{
    CHECK_THROWS_WITH_AS(LawMaterial<LittleLaw<Fault::miscounted>>(little_parameters<Fault::none>()),
                         "the law's state_count is 2, but its state_variables() lists 1", std::logic_error);
}

TEST_CASE("a law that knows the x axis is not objective")
{
    check_mentions(said_by<Fault::direction>("objectivity"), {"with everything turned", "the stress is", "off by"});
}

TEST_CASE("a shear modulus of the pressure alone does not close an elastic loop")
{
    check_mentions(said_by<Fault::pressure_dependence>("elastic loop"), {"does not return", "are left of"});
}

TEST_CASE("flow against the stress gives out energy in a step")
{
    check_mentions(said_by<Fault::flow_against_stress>("dissipation"), {"work less stored energy is -"});
}

TEST_CASE("unloading softer than loading gives out energy in a cycle")
{
    check_mentions(said_by<Fault::soft_unloading>("dissipation"), {"a cycle that returns to the stress", "gives out"});
}

TEST_CASE("a strain remembered outside the state variables shows in repetition and restart")
{
    check_mentions(said_by<Fault::hidden_state>("repetition"), {"end elsewhere", "the stress is"});
    check_mentions(said_by<Fault::hidden_state>("restart"), {"after a restart", "end elsewhere"});
}

TEST_CASE("a member that two threads write shows when two threads call")
{
    check_mentions(said_by<Fault::shared_scratch>("threads"), {"while another thread", "end elsewhere"});
    CHECK(said_by<Fault::shared_scratch>("repetition").empty()); // each by itself is right
}

TEST_CASE("a stress that is not a number with the status converged is found")
{
    check_mentions(said_by<Fault::not_a_number>("hostile input"), {"gives the stress", "nan", "the status converged"});
}

TEST_CASE("a failure without a reason is found")
{
    check_mentions(said_by<Fault::no_reason>("hostile input"), {"fails without a reason"});
}

TEST_CASE("a parameter that the constructor does not read is named")
{
    const std::vector<std::string> faults =
        kit::check_law<LittleLaw<Fault::unread_parameter>>(little_parameters<Fault::unread_parameter>());
    check_mentions(sentence_of("parameters", faults), {"'colour'", "never asks for it"});
    CHECK(faults.size() == 1);
}

TEST_CASE("a parameter that is read and not declared is named")
{
    const std::vector<std::string> faults =
        kit::check_law<LittleLaw<Fault::undeclared_parameter>>(little_parameters<Fault::undeclared_parameter>());
    check_mentions(sentence_of("parameters", faults), {"'porosity'", "not declared"});
    CHECK(faults.size() == 1);
}

TEST_CASE("tension beyond the limit is found along a path and in one huge step")
{
    check_mentions(said_by<Fault::unlimited_tension>("tension"), {"mean tension of", "the limit is 0 Pa"});
    check_mentions(said_by<Fault::unlimited_tension>("hostile input"), {"mean tension of", "the limit is 0 Pa"});
}

TEST_CASE("a law that claims to bear tension may bear it")
{
    kit::Range range;
    range.tension_limit = std::numeric_limits<double>::infinity();
    CHECK(said_by<Fault::unlimited_tension>("tension", range).empty());
    CHECK(said_by<Fault::unlimited_tension>("hostile input", range).empty());
}

TEST_CASE("a stress that fades by the call does not converge with the step")
{
    check_mentions(said_by<Fault::fading_by_call>("step convergence"), {"when 16, 32, 64 and 128 steps are halved"});
}

TEST_CASE("lanes that weaken each other are found" * doctest::skip(pack_width == 1))
{
    check_mentions(said_by<Fault::coupled_lanes>("lanes"), {"among other points", "in bond", "the stress is"});
}

TEST_CASE("a failure that spreads over a pack spoils points beside empty lanes" * doctest::skip(pack_width == 1))
{
    check_mentions(said_by<Fault::spreading_failure>("inactive lanes"), {"makes bond", "fail", "not a finite number"});
}

TEST_CASE("a stiffness above the reported moduli is found")
{
    check_mentions(said_by<Fault::understated_modulus>("stiffness"), {"meets 45000000", "K + 4/3 G = 32500000"});
}

TEST_CASE("an initial state that cannot bear its stress is found")
{
    check_mentions(said_by<Fault::weak_initial_state>("initial state"),
                   {"after a step without strain", "the stress is"});
}

TEST_CASE("a call that takes too long is found")
{
    kit::Range range;
    range.call_limit = 0.01; // it searches for 0.05 s
    check_mentions(said_by<Fault::endless_search>("hostile input", range), {"s of processor time", "more than 0.01 s"});
}

TEST_CASE("an update by packs that differs from that by doubles is found")
{
    const std::string fault =
        sentence_of("packs", kit::check_law<LittleLaw<Fault::packs_differ>>(little_parameters<Fault::packs_differ>()));
    check_mentions(fault, {"of an update by packs", "in lane", "the stress is"});
}

TEST_CASE("an initial state by packs that differs from that by doubles is found")
{
    const std::string fault = sentence_of("packs", kit::check_law<LittleLaw<Fault::initial_packs_differ>>(
                                                       little_parameters<Fault::initial_packs_differ>()));
    check_mentions(fault, {"of an initial state by packs", "state variable friction"});
}
