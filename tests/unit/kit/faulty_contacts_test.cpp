// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The contact kit finds every fault of a contact law, and a sound law passes.
#include "little_laws.hpp"
#include "periporo/contact_kit.hpp"
#include "support/errors.hpp"

#include <doctest/doctest.h>

#include <map>

using namespace periporo;
using namespace periporo::test;

namespace {

enum class ContactFault {
    none,
    reaches_too_far,
    not_a_number,
    unset,
    counts_pairs,
    energy_of_half,
    energy_at_reach,
    soft_stiffness,
    drives,
    damps_at_rest,
    hidden_damping,
    pulls,
    larger_point_first,
    bounces_higher,
    dead_at_surface
};

/// A linear spring and dashpot with one fault.
template <ContactFault fault>
class FaultyContact : public Contact {
public:
    static std::vector<Parameter> parameters()
    {
        return {Parameter::real("stiffness", dimension::spring, "Spring k").above(0.0)};
    }
    explicit FaultyContact(const Parameters& parameters) : stiffness_(parameters.real("stiffness")) {}
    void scale(const ContactScale& scale) override { cutoff_ = 0.8 * scale.spacing; }
    double cutoff() const override { return cutoff_; }
    double friction() const override { return 0.3; }
    void evaluate(std::span<const ContactPair> pairs, std::span<ContactResponse> responses) const override
    {
        for (std::size_t i = 0; i < pairs.size(); ++i)
            if (fault != ContactFault::unset || i > 0 || pairs[i].distance > 0.3 * cutoff_)
                responses[i] = response(pairs[i], i);
    }

private:
    ContactResponse response(ContactPair pair, [[maybe_unused]] std::size_t number) const
    {
        if (fault == ContactFault::dead_at_surface && pair.mass_b == 0.0)
            pair.approach_speed = 0.0;
        const double reach = fault == ContactFault::reaches_too_far ? 1.1 * cutoff_ : cutoff_;
        ContactResponse result = spring_and_dashpot(reach - pair.distance, stiffness_, ratio, pair);
        if (pair.distance >= reach)
            return result;
        const double speed = pair.approach_speed;
        if (fault == ContactFault::not_a_number && pair.distance <= 0.0)
            result.force = std::sqrt(-1.0);
        if (fault == ContactFault::counts_pairs)
            result.force *= 1.0 + 1e-9 * static_cast<double>(number);
        if (fault == ContactFault::energy_of_half)
            result.energy *= 0.5;
        if (fault == ContactFault::energy_at_reach)
            result.energy += 0.01 * stiffness_ * cutoff_ * cutoff_;
        if (fault == ContactFault::soft_stiffness)
            result.stiffness *= 0.9;
        if (fault == ContactFault::drives)
            result = {result.force - result.damping_force - 0.01 * speed, result.stiffness, result.energy,
                      -0.01 * speed};
        if (fault == ContactFault::damps_at_rest)
            result.force += 0.01, result.damping_force += 0.01;
        if (fault == ContactFault::hidden_damping)
            result.damping_force = 0.0;
        if (fault == ContactFault::pulls)
            result.damping_force = 5.0 * speed,
            result.force = stiffness_ * (cutoff_ - pair.distance) + result.damping_force;
        if (fault == ContactFault::larger_point_first && pair.mass_b > 0.0)
            result.force *= pair.volume_a > pair.volume_b ? 1.01 : 1.0;
        if (fault == ContactFault::bounces_higher && speed < 0.0) // the spring is stiffer on the way back
            result.force *= 1.3;
        return result;
    }

    static constexpr double ratio = 0.4;
    double stiffness_;    // [N/m]
    double cutoff_ = 0.0; // [m]
};

template <ContactFault fault>
kit::Faults faults_of(const kit::ContactRange& range = {})
{
    using Law = FaultyContact<fault>;
    return kit::check_contact_law<Law>(kit::parameters_of(Law::parameters(), {{"stiffness", 1000.0}}), range);
}

/// The sentence of the check with this name about a law with this fault.
template <ContactFault fault>
std::string sentence_about(const std::string& check, const kit::ContactRange& range = {})
{
    return sentence_of(check, faults_of<fault>(range));
}

} // namespace

TEST_CASE("a sound contact law has no faults")
{
    for (const std::string& fault : faults_of<ContactFault::none>())
        FAIL_CHECK(fault);
}

TEST_CASE("a contact that acts beyond its reach is noticed")
{
    check_mentions(sentence_about<ContactFault::reaches_too_far>("reach"), {"of cutoff()", "must be 0"});
}

TEST_CASE("a response that is not a number, or that is left unset, is noticed")
{
    check_mentions(sentence_about<ContactFault::not_a_number>("not finite"), {"the force is", "nan"});
    check_mentions(sentence_about<ContactFault::unset>("not finite"), {"nan"});
}

TEST_CASE("a response that depends on the place of the pair in its block is noticed")
{
    check_mentions(sentence_about<ContactFault::counts_pairs>("blocks"), {"of a block of", "and alone"});
}

TEST_CASE("a force that is not the slope of the stored energy is noticed, and energy that is left at the reach")
{
    check_mentions(sentence_about<ContactFault::energy_of_half>("stored energy"), {"the slope of the energy"});
    check_mentions(sentence_about<ContactFault::energy_at_reach>("stored energy"), {"just inside cutoff()"});
}

TEST_CASE("a stiffness below the slope of the force is noticed")
{
    check_mentions(sentence_about<ContactFault::soft_stiffness>("stiffness"), {"900", "1000", "too long"});
}

TEST_CASE("a damping force that drives the motion, acts at rest, or is not told is noticed")
{
    check_mentions(sentence_about<ContactFault::drives>("damping"), {"drives the motion"});
    check_mentions(sentence_about<ContactFault::damps_at_rest>("damping"), {"at rest", "must be 0"});
    check_mentions(sentence_about<ContactFault::hidden_damping>("damping"), {"without its damping part"});
}

TEST_CASE("a contact that pulls is noticed, unless its limit allows the pull")
{
    check_mentions(sentence_about<ContactFault::pulls>("pull"), {"pulls with", "the limit is 0 N"});
    kit::ContactRange range;
    range.pull_limit = 1e6;
    for (const std::string& fault : faults_of<ContactFault::pulls>(range))
        CHECK_FALSE(fault.starts_with("pull"));
}

TEST_CASE("a force that depends on the order of the two points breaks momentum and is noticed")
{
    check_mentions(sentence_about<ContactFault::larger_point_first>("momentum"), {"change places"});
}

TEST_CASE("a collision that ends faster than it began, or with another restitution than claimed, is noticed")
{
    // The loss of zeta = 0.4 leaves e = exp(-2 zeta acos(zeta)/(1 - zeta^2)^(1/2)) = 0.364; a spring 1.3 times as stiff
    // on the way back gives back up to 1.3^(1/2) more.
    kit::ContactRange range;
    range.restitution = 0.364;
    CHECK(faults_of<ContactFault::none>(range).empty());
    check_mentions(sentence_about<ContactFault::bounces_higher>("restitution", range), {"the law claims 0.364"});
    range.restitution = 0.5;
    check_mentions(sentence_about<ContactFault::none>("restitution", range), {"has 0.3", "the law claims 0.5"});
}

TEST_CASE("a dashpot that does nothing at a rigid surface is noticed")
{
    check_mentions(sentence_about<ContactFault::dead_at_surface>("rigid surface"), {"restitution", "reduced_mass()"});
}

namespace {

class BentSurface : public RigidSurface {
public:
    double distance(const Vector3& position, Vector3& normal) const override
    {
        normal = {0.0, 0.0, 1.0};
        return 1.2 * position.z();
    }
};

} // namespace

TEST_CASE("a surface whose distance grows by more than a metre a metre is noticed")
{
    check_mentions(sentence_of("surface", kit::check_surface(BentSurface())), {"the distance grows by"});
}
