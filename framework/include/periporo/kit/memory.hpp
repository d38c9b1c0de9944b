// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// All that a law remembers is in its state variables: restart, repetition, other points and other threads change no
// bit.
#pragma once

#include "periporo/kit/points.hpp"

#include <barrier>
#include <exception>
#include <thread>

namespace periporo::kit {

namespace detail {

/// A point on its way along a random strain path of its own.
class Walker {
public:
    Walker(const MaterialPoint& start, const Range& range, double size, std::uint64_t seed)
        : point_(start), time_step_(range.time_step), size_(size), random_(seed)
    {
    }

    void step() { point_.step(random_.tensor(size_), time_step_); } // a failed step leaves the point: also an answer
    void walk(int steps)
    {
        for (int n = 0; n < steps; ++n)
            step();
    }
    const MaterialPoint& point() const { return point_; }

    /// Continues with nothing but stress, state variables and water.
    void restart()
    {
        MaterialPoint anew(point_.material(), point_.stress());
        anew.set_water(point_.suction(), point_.saturation());
        for (std::size_t s = 0; s < point_.material().state_variables().size(); ++s)
            anew.set_state(s, point_.state(s));
        point_ = anew;
    }

private:
    MaterialPoint point_;
    double time_step_;
    double size_;
    Random random_;
};

inline std::string same_bits(const Walker& found, const Walker& expected)
{
    return difference(values(found.point()), values(expected.point()), expected.point().material(), 0.0, 0.0);
}

} // namespace detail

/// A path that is left in the middle and taken up again from its stress and state, after others, ends with the same
/// bits.
inline Faults check_restart(const Material& material, const Range& range = {})
{
    Random random;
    for (const MaterialPoint& start : starting_points(material, range, random))
        for (const double size : range.strain_increments) {
            detail::Walker whole(start, range, size, 1), restarted(start, range, size, 1);
            restarted.walk(10);
            whole.walk(20);
            restarted.restart();
            restarted.walk(10);
            if (const std::string fault = detail::same_bits(restarted, whole); !fault.empty())
                return {sentence("restart: 10 of 20 steps of ", size, " from p = ", mean_pressure(start.stress()),
                                 " Pa, taken after a restart from the state variables, end elsewhere: ", fault)};
        }
    return {};
}

/// The same call gives the same bits again, and two points that are stepped in turn do not disturb each other.
inline Faults check_repetition(const Material& material, const Range& range = {})
{
    Random random;
    for (const MaterialPoint& start : starting_points(material, range, random))
        for (const double size : range.strain_increments) {
            detail::Walker alone(start, range, size, 1), again(start, range, size, 1);
            alone.walk(20);
            again.walk(20);
            if (const std::string fault = detail::same_bits(again, alone); !fault.empty())
                return {sentence("repetition: the same 20 steps of ", size, " from p = ", mean_pressure(start.stress()),
                                 " Pa end elsewhere the second time: ", fault)};
            detail::Walker in_turn(start, range, size, 1), other(start, range, 2.0 * size, 2);
            for (int n = 0; n < 20; ++n) {
                in_turn.step();
                other.step();
            }
            if (const std::string fault = detail::same_bits(in_turn, alone); !fault.empty())
                return {sentence("repetition: 20 steps of ", size, " from p = ", mean_pressure(start.stress()),
                                 " Pa in turn with another point end elsewhere: ", fault)};
        }
    return {};
}

namespace detail {

/// Two walkers, each in a thread of its own.
inline void walk_together(std::vector<Walker>& walkers, int steps)
{
    std::barrier start_together(2);
    std::exception_ptr thrown;
    const auto walk = [&](Walker& walker) {
        start_together.arrive_and_wait();
        walker.walk(steps);
    };
    std::thread second([&] {
        try {
            walk(walkers[1]);
        } catch (...) {
            thrown = std::current_exception();
        }
    });
    try {
        walk(walkers[0]);
    } catch (...) {
        second.join();
        throw;
    }
    second.join();
    if (thrown)
        std::rethrow_exception(thrown);
}

} // namespace detail

/// Two threads that call the law at once get the bits that each gets alone.
inline Faults check_threads(const Material& material, const Range& range = {})
{
    constexpr int steps = 500;
    constexpr int rounds = 10; // on a busy machine one thread may end before the other one gets a core
    const double size = range.strain_increments.back();
    std::vector<detail::Walker> start, alone;
    for (const std::uint64_t seed : {1, 2}) {
        start.emplace_back(
            starting_point(material, range, SymmetricTensor<double>::isotropic(-range.pressures.front())), range, size,
            seed);
        alone.push_back(start.back());
        alone.back().walk(steps);
    }
    for (int round = 0; round < rounds; ++round) {
        std::vector<detail::Walker> together = start;
        detail::walk_together(together, steps);
        for (std::size_t n = 0; n < 2; ++n)
            if (const std::string fault = detail::same_bits(together[n], alone[n]); !fault.empty())
                return {sentence("threads: ", steps, " steps of ", size,
                                 " while another thread calls the law too end elsewhere: ", fault)};
    }
    return {};
}

} // namespace periporo::kit
