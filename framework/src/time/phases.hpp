// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Where the time of a run goes.
#pragma once

#include "model/operator_result.hpp"

#include <array>
#include <chrono>
#include <cstddef>

namespace periporo {

enum class Phase : std::size_t {
    refresh,       ///< families, sub-horizons, accumulators and the states of bonds anew
    kinematics,    ///< operator: sums over families and velocity gradients
    material,      ///< operator: rotation of stress and the material
    force,         ///< operator: from stress to forces on points
    contact,       ///< contact laws
    integration,   ///< motion of the points, energies, values at the ends of bonds
    step_estimate, ///< largest frequency of the operator
    output         ///< results and checkpoints
};
inline constexpr std::size_t phase_count = 8;
inline constexpr const char* phase_names[phase_count] = {"refresh", "kinematics",  "material",      "force",
                                                         "contact", "integration", "step_estimate", "output"};

/// Wall-clock seconds by phase.
class PhaseTimes {
public:
    double operator[](Phase phase) const { return seconds_[static_cast<std::size_t>(phase)]; }
    double total() const;

    /// Runs `work` on the clock of a phase.
    template <class Work>
    void time(Phase phase, Work&& work)
    {
        const auto begin = std::chrono::steady_clock::now();
        work();
        add(phase, std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
    }

    /// Runs an evaluation of the operator; its time is divided by the samples that it took of its parts.
    /// @param samples to which the evaluation adds
    template <class Work>
    void time_operator(OperatorTimes& samples, Work&& work)
    {
        samples = {};
        const auto begin = std::chrono::steady_clock::now();
        work();
        const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
        const double sampled = samples.kinematics + samples.material + samples.force;
        if (!(sampled > 0.0))
            return add(Phase::kinematics, seconds);
        add(Phase::kinematics, seconds * samples.kinematics / sampled);
        add(Phase::material, seconds * samples.material / sampled);
        add(Phase::force, seconds * samples.force / sampled);
    }

private:
    void add(Phase phase, double seconds) { seconds_[static_cast<std::size_t>(phase)] += seconds; }

    std::array<double, phase_count> seconds_{};
};

inline double PhaseTimes::total() const
{
    double sum = 0.0;
    for (const double seconds : seconds_)
        sum += seconds;
    return sum;
}

} // namespace periporo
