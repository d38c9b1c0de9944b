// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Inside the elastic domain a closed strain loop gives back stress, energy and state.
#pragma once

#include "periporo/kit/block.hpp"

#include <optional>

namespace periporo::kit {

namespace detail {

/// Whether the law answers a small strain forth and back alike and stays where it is without strain: whether there is
/// an elastic domain about this point in this direction.
inline bool reversible(const MaterialPoint& point, const SymmetricTensor<double>& strain, double time_step)
{
    MaterialPoint forth = point, back = point, rest = point;
    if (!forth.step(strain, time_step).converged || !back.step(strain * -1.0, time_step).converged ||
        !rest.step({}, time_step).converged)
        return false;
    constexpr double nearly = 0.01; // a change of modulus over the step is far less, yielding is far more
    const double change = norm(forth.stress() - back.stress());
    return norm(forth.stress() + back.stress() - point.stress() * 2.0) <= nearly * change &&
           norm(rest.stress() - point.stress()) <= nearly * change;
}

struct LoopEnd {
    MaterialPoint point;
    double work;           ///< of the stress above that of the start [J/m3]
    double moved;          ///< the same with every step counted positive [J/m3]
    double largest_change; ///< of stress [Pa]
};

/// Walks round the parallelogram of two strains; nothing when the way is not elastic.
inline std::optional<LoopEnd> walk_round(const MaterialPoint& start, const SymmetricTensor<double>& first,
                                         const SymmetricTensor<double>& second, int steps, double time_step)
{
    LoopEnd end{start, 0.0, 0.0, 0.0};
    for (const SymmetricTensor<double>& leg : {first, second, first * -1.0, second * -1.0}) {
        const SymmetricTensor<double> strain = leg * (1.0 / steps);
        for (const SymmetricTensor<double>& direction : {first, second})
            if (!reversible(end.point, direction * (1.0 / steps), time_step))
                return std::nullopt;
        for (int step = 0; step < steps; ++step) {
            const SymmetricTensor<double> before = end.point.stress() - start.stress();
            if (!end.point.step(strain, time_step).converged)
                return std::nullopt;
            const SymmetricTensor<double> after = end.point.stress() - start.stress();
            const double work = 0.5 * double_contraction(before + after, strain);
            end.work += work;
            end.moved += std::abs(work);
            end.largest_change = std::max(end.largest_change, norm(after));
        }
    }
    return end;
}

} // namespace detail

/// Walks closed strain loops of a twentieth of the pressure. The stress must return, the work must vanish and the state
/// variables must be what they were. A law without an elastic domain, one that yields at any strain or relaxes in time,
/// has nothing to be checked here.
inline Faults check_elastic_loop(const Material& material, const Range& range = {})
{
    constexpr double size = 0.05; // of the change of stress along a leg, relative to p
    constexpr int steps = 50;     // along a leg
    // a law that integrates its moduli to first order is off by the change of stress over one step: size/steps
    constexpr double tolerance = size / steps;
    Random random;
    for (const MaterialPoint& start : starting_points(material, range, random)) {
        const double pressure = mean_pressure(start.stress());
        const double amplitude = size * pressure / largest_stiffness(material);
        // the volumetric part of one leg and the shear of the other make a modulus that changes on the way felt
        const SymmetricTensor<double> first =
            SymmetricTensor<double>::isotropic(-amplitude) + deviator(random.tensor(0.5 * amplitude));
        const SymmetricTensor<double> second = deviator(random.tensor(amplitude));
        const std::optional<detail::LoopEnd> end = detail::walk_round(start, first, second, steps, range.time_step);
        if (!end)
            continue;
        const std::string place = sentence(" in a closed strain loop of ", amplitude, " about p = ", pressure, " Pa");
        const double left = norm(end->point.stress() - start.stress());
        const double round_off = range.accuracy * stress_scale(material, start.stress(), first);
        if (!(left <= tolerance * end->largest_change + round_off))
            return {sentence("elastic loop: the stress does not return", place, ": ", left, " Pa are left of ",
                             end->largest_change, " Pa")};
        if (!(std::abs(end->work) <= tolerance * end->moved + round_off * amplitude))
            return {sentence("elastic loop: the work does not return", place, ": ", end->work, " J/m3 are left of ",
                             end->moved, " J/m3")};
        const std::string state =
            difference({start.stress(), values(end->point).state}, values(start), material, 0.0, range.accuracy);
        if (!state.empty())
            return {"elastic loop:" + place + " " + state};
    }
    return {};
}

/// The elastic response that a case may ask for leaves the state as it is, bit by bit, and gives back the stress of a
/// strain that is taken back.
inline Faults check_elastic_response(const Material& material, const Range& range = {})
{
    Random random;
    for (const MaterialPoint& start : starting_points(material, range, random))
        for (const double size : range.strain_increments) {
            const SymmetricTensor<double> strain = random.tensor(size);
            BlockPoint point = block_point(start, strain);
            for (const double sign : {1.0, -1.0}) {
                point.strain_increment = strain * sign;
                Block block(material, {point});
                if (const MaterialStatus status = block.update(range.time_step, MaterialResponse::elastic);
                    !status.converged)
                    return {stopped("elastic response", start, strain, status)};
                point.old = block.values(0);
            }
            const double tolerance = range.accuracy * stress_scale(material, start.stress(), strain);
            const std::string fault = difference(point.old, values(start), material, tolerance, 0.0);
            if (!fault.empty())
                return {sentence("elastic response: after a strain of ", size, " and back ", fault)};
        }
    return {};
}

} // namespace periporo::kit
