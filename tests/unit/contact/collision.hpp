// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Two masses on a line, or a mass above a rigid surface, under a contact law alone.
#pragma once

#include "periporo/contact.hpp"

#include <doctest/doctest.h>

#include <cmath>

namespace periporo::test {

/// A point or a surface; a rigid surface has neither mass nor volume, and stays.
struct Side {
    double mass = 0.0;   ///< [kg]
    double volume = 0.0; ///< [m3]
    ContactPartner kind = ContactPartner::points;
    double position = 0.0;
    double velocity = 0.0;
};

/// Velocity Verlet. Each of two points evaluates the contact for itself, as in the framework; a surface is pushed by
/// what the point feels.
class Collision {
public:
    /// The sides come closer with `speed`, and are as good as in contact: they touch with the first step.
    /// @param distance between them, or of the upper above the surface [m]
    Collision(const Contact& law, Side upper, Side lower, double distance, double speed)
        : law_(law), upper_(upper), lower_(lower)
    {
        upper_.position = std::nextafter(distance, 0.0);
        upper_.velocity = -speed;
    }

    /// A step that resolves the stiffest oscillation of the law, with 6283 steps a period [s].
    double fine_step() const
    {
        const ContactPair pair = seen_from(upper_, lower_);
        return 1e-3 * std::sqrt(reduced_mass(pair) / answer_at(0.0, pair).stiffness);
    }

    void step(double time_step)
    {
        const double power = damping_power();
        push(0.5 * time_step, upper_.velocity, lower_.velocity);
        upper_.position += time_step * upper_.velocity;
        lower_.position += time_step * lower_.velocity;
        // The dashpot makes the second half implicit; each round leaves zeta omega dt < 2e-3 of the error.
        const double half_upper = upper_.velocity;
        const double half_lower = lower_.velocity;
        for (int round = 0; round < 4; ++round)
            push(0.5 * time_step, half_upper, half_lower);
        damped_ += 0.5 * time_step * (power + damping_power());
        time_ += time_step;
    }

    /// Goes on until `done(*this)`, at the fine step.
    template <class Done>
    void run_until(Done&& done)
    {
        const double time_step = fine_step();
        for (int n = 0; !done(*this); ++n) {
            REQUIRE(n < 1000000);
            step(time_step);
        }
    }

    double time() const { return time_; }
    double distance() const { return upper_.position - lower_.position; }
    double opening_speed() const { return upper_.velocity - lower_.velocity; }
    double momentum() const { return upper_.mass * upper_.velocity + lower_.mass * lower_.velocity; }
    double kinetic() const
    {
        return 0.5 *
               (upper_.mass * upper_.velocity * upper_.velocity + lower_.mass * lower_.velocity * lower_.velocity);
    }
    double stored() const { return answer(upper_, lower_).energy; }
    double force() const { return answer(upper_, lower_).force; }
    /// Taken by the dashpot so far [J].
    double damped() const { return damped_; }
    bool apart() const { return opening_speed() > 0.0 && distance() >= law_.cutoff(); }

private:
    ContactPair seen_from(const Side& a, const Side& b) const
    {
        return {distance(), -opening_speed(), a.volume, b.volume, a.mass, b.mass};
    }

    ContactResponse answer_at(double distance, ContactPair pair) const
    {
        pair.distance = distance;
        ContactResponse response;
        law_.evaluate({&pair, 1}, {&response, 1});
        return response;
    }

    ContactResponse answer(const Side& a, const Side& b) const { return answer_at(distance(), seen_from(a, b)); }

    double damping_power() const { return -answer(upper_, lower_).damping_force * opening_speed(); }

    /// The velocities that the forces at hand make of others in a time.
    void push(double time, double from_upper, double from_lower)
    {
        const double on_upper = answer(upper_, lower_).force;
        const double on_lower = lower_.kind == ContactPartner::points ? -answer(lower_, upper_).force : -on_upper;
        upper_.velocity = from_upper + time / upper_.mass * on_upper;
        if (lower_.mass > 0.0)
            lower_.velocity = from_lower + time / lower_.mass * on_lower;
    }

    const Contact& law_;
    Side upper_;
    Side lower_;
    double time_ = 0.0;
    double damped_ = 0.0;
};

} // namespace periporo::test
