// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// A law may swallow work, and gives none that it was not given.
#pragma once

#include "periporo/kit/points.hpp"

#include <optional>

namespace periporo::kit {

namespace detail {

/// Elastic strain of a stress, by Hooke's law with the moduli that the material reports [-].
inline SymmetricTensor<double> elastic_strain(const Material& material, const SymmetricTensor<double>& stress)
{
    return deviator(stress) * (0.5 / material.shear_modulus()) +
           SymmetricTensor<double>::isotropic(trace(stress) / (9.0 * material.bulk_modulus()));
}

/// Whether the law about this point is Hooke's with the reported moduli, forth and back.
inline bool hookean(const MaterialPoint& point, const Range& range, Random& random)
{
    const Material& material = point.material();
    const SymmetricTensor<double> probe =
        random.tensor(1e-3 * mean_pressure(point.stress()) / largest_stiffness(material));
    for (const double sign : {1.0, -1.0}) {
        MaterialPoint moved = point;
        if (!moved.step(probe * sign, range.time_step).converged)
            return false;
        const SymmetricTensor<double> plastic =
            probe * sign - elastic_strain(material, moved.stress() - point.stress());
        if (norm(plastic) > 1e-3 * norm(probe))
            return false;
    }
    return true;
}

/// Work less stored energy of one step must not be negative. See check_dissipation.
inline std::string dissipation_fault(const MaterialPoint& before, const MaterialPoint& after,
                                     const SymmetricTensor<double>& strain, const Range& range)
{
    const Material& material = before.material();
    const SymmetricTensor<double> plastic = strain - elastic_strain(material, after.stress() - before.stress());
    const double dissipated =
        std::max(double_contraction(before.stress(), plastic), double_contraction(after.stress(), plastic));
    const double scale = stress_scale(material, before.stress(), strain);
    // round-off: the plastic strain is the small difference of two of the size of scale/stiffness
    if (dissipated >= -range.accuracy * scale * (norm(strain) + scale / largest_stiffness(material)))
        return {};
    return sentence("dissipation: a step of ", norm(strain), " at the stress ", text(before.stress()),
                    " Pa with the strain increment ", text(strain), " gives the stress ", text(after.stress()),
                    " Pa: work less stored energy is ", dissipated, " J/m3");
}

/// Work of a random walk and of the way back to the stress it began with; nothing when a step fails or the stress
/// cannot be reached again.
struct Cycle {
    double work;  ///< [J/m3]
    double error; ///< what the sum over steps may be off [J/m3]
};
inline std::optional<Cycle> stress_cycle(const MaterialPoint& start, const Range& range, Random& random)
{
    constexpr int legs = 4, steps = 50;
    MaterialPoint point = start;
    Cycle cycle{0.0, 0.0};
    const auto add = [&](const MaterialPoint& before) {
        const SymmetricTensor<double> strain = point.strain() - before.strain();
        const SymmetricTensor<double> change = point.stress() - before.stress();
        cycle.work += double_contraction(before.stress() + change * 0.5, strain);
        cycle.error += 0.5 * norm(change) * norm(strain);
    };
    const double size = 2.0 * mean_pressure(start.stress()) / largest_stiffness(start.material());
    for (int leg = 0; leg < legs; ++leg) {
        const SymmetricTensor<double> strain = random.tensor(random.number(0.1, 1.0) * size / steps);
        for (int step = 0; step < steps; ++step) {
            const MaterialPoint before = point;
            if (!point.step(strain, range.time_step).converged)
                return std::nullopt;
            add(before);
        }
    }
    const SymmetricTensor<double> back = (start.stress() - point.stress()) * (1.0 / steps);
    MixedStep home{{true, true, true, true, true, true}, components(back)};
    home.time_step = range.time_step;
    home.tolerance = 1e-9 * norm(start.stress());
    for (int step = 0; step < steps; ++step) {
        const MaterialPoint before = point;
        if (!point.step(home).converged)
            return std::nullopt;
        add(before);
    }
    return cycle;
}

} // namespace detail

/// Two statements, for laws whose hardening stores no energy.
///
/// Step by step, where the law is Hooke's with the reported moduli inside its elastic domain: with the free energy
/// psi = p^2/(2 K) + q^2/(6 G) of the stress alone, work less d psi is exactly sigma : d eps_p with
/// d eps_p = d eps - C^-1 d sigma. During a step that flows the stress lies between its old and its new value, so one
/// of the two must give sigma : d eps_p >= 0. A backward-Euler return to a convex surface about zero stress does so
/// with its new stress.
///
/// In a cycle, whatever the moduli: stress at the end as at the beginning is psi as at the beginning, so the work is
/// what was dissipated and not negative. The sum over the steps misses the integral by at most half of
/// |d sigma||d eps| of each. Stresses that cannot be reached again, after softening, leave the cycle out.
inline Faults check_dissipation(const Material& material, const Range& range = {})
{
    if (range.stores_energy)
        return {};
    constexpr int steps = 50;
    Random random;
    const std::vector<MaterialPoint> starts = starting_points(material, range, random);
    const bool hookean = std::all_of(starts.begin(), starts.end(),
                                     [&](const MaterialPoint& start) { return detail::hookean(start, range, random); });
    for (const MaterialPoint& start : starts) {
        if (hookean)
            for (const double size : range.strain_increments) {
                MaterialPoint point = start;
                SymmetricTensor<double> strain;
                for (int step = 0; step < steps; ++step) {
                    if (step % 5 == 0)
                        strain = random.tensor(size);
                    const MaterialPoint before = point;
                    if (const MaterialStatus status = point.step(strain, range.time_step); !status.converged)
                        return {stopped("dissipation", before, strain, status)};
                    if (std::string fault = detail::dissipation_fault(before, point, strain, range); !fault.empty())
                        return {fault};
                }
            }
        for (int cycle = 0; cycle < 3; ++cycle)
            if (const std::optional<detail::Cycle> done = detail::stress_cycle(start, range, random);
                done && !(done->work >= -done->error))
                return {sentence("dissipation: a cycle that returns to the stress ", text(start.stress()),
                                 " Pa gives out ", -done->work, " J/m3 of work, where its sum may be off by ",
                                 done->error, " J/m3")};
    }
    return {};
}

} // namespace periporo::kit
