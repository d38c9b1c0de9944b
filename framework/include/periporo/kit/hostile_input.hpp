// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Input that no sound run gives is answered soon, by a status or by finite numbers.
#pragma once

#include "periporo/kit/block.hpp"
#include "periporo/kit/tension.hpp"

#include <ctime>
#include <limits>
#include <utility>

namespace periporo::kit {

namespace detail {

/// Makes one call and judges the answer; empty when it is sound. A value that was handed in as not-a-number may come
/// back in its place.
inline std::string hostile_fault(const Material& material, const BlockPoint& point, double time_step,
                                 const Range& range, bool judge_tension)
{
    Block block(material, {point});
    const std::clock_t begin = std::clock(); // of the processor: another program at work does not count
    const MaterialStatus status = block.update(time_step);
    const double seconds = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
    if (seconds > range.call_limit)
        return sentence("takes ", seconds, " s of processor time, more than ", range.call_limit, " s");
    if (!status.converged) {
        if (status.reason == nullptr || *status.reason == '\0')
            return "fails without a reason";
        return status.bond == 0 ? std::string() : sentence("fails at bond ", status.bond, ", and there is only bond 0");
    }
    const Values answer = block.values(0);
    if (!finite(answer.stress))
        return sentence("gives the stress ", text(answer.stress), " Pa and the status converged");
    for (std::size_t s = 0; s < answer.state.size(); ++s)
        if (!std::isfinite(answer.state[s]) && std::isfinite(point.old.state[s]))
            return sentence("gives ", answer.state[s], " for the state variable ", material.state_variables()[s].name,
                            " and the status converged");
    const double tension = -mean_pressure(answer.stress);
    const double round_off = range.accuracy * stress_scale(material, point.old.stress, point.strain_increment);
    if (judge_tension && !(tension <= range.tension_limit + tension_slack(range) + round_off))
        return sentence("gives a mean tension of ", tension, " Pa and the status converged; the limit is ",
                        range.tension_limit, " Pa");
    return {};
}

inline std::string in_words(const BlockPoint& point, double time_step)
{
    return sentence("hostile input: the stress ", text(point.old.stress), " Pa with the strain increment ",
                    text(point.strain_increment), " over ", time_step, " s ");
}

} // namespace detail

/// Strain steps of 1 to 1e6 in all directions, over a time step and over none, from no stress, hardly any, an ordinary
/// one, a huge one and one in tension. A law that does not depend on the rate must also give no more tension than its
/// limit.
inline Faults check_huge_steps(const Material& material, const Range& range = {})
{
    Random random;
    const double ordinary = range.pressures.front();
    for (const double pressure : {0.0, 1e-6, ordinary, 1e12, -ordinary})
        for (const double size : {0.0, 1.0, 1e2, 1e4, 1e6})
            for (const SymmetricTensor<double>& direction :
                 {SymmetricTensor<double>::isotropic(1.0), SymmetricTensor<double>::isotropic(-1.0),
                  SymmetricTensor<double>{0.0, 0.0, -1.0, 0.0, 0.0, 0.0},
                  SymmetricTensor<double>{0.0, 0.0, 0.0, 1.0, 0.0, 0.0}, random.tensor(1.0)})
                for (const double time_step : {range.time_step, 0.0}) {
                    const MaterialPoint start =
                        starting_point(material, range, SymmetricTensor<double>::isotropic(-pressure));
                    const BlockPoint point = block_point(start, direction * size);
                    const bool judge_tension = !range.rate_dependent && time_step > 0.0;
                    const std::string fault = detail::hostile_fault(material, point, time_step, range, judge_tension);
                    if (!fault.empty())
                        return {detail::in_words(point, time_step) + fault};
                }
    return {};
}

/// Not-a-number and infinity, one at a time, in stress, strain increment, state, water and time step.
inline Faults check_not_finite_input(const Material& material, const Range& range = {})
{
    const MaterialPoint start =
        starting_point(material, range, SymmetricTensor<double>::isotropic(-range.pressures.front()));
    BlockPoint point = block_point(start, {-1e-4, 2e-4, 1e-4, 1e-4, -2e-4, 1e-4});
    double time_step = range.time_step;
    std::vector<std::pair<std::string, double*>> places;
    for (auto [name, tensor] : {std::pair("stress ", &point.old.stress), {"strain ", &point.strain_increment}}) {
        std::size_t c = 0;
        for (double* value : {&tensor->xx, &tensor->yy, &tensor->zz, &tensor->xy, &tensor->yz, &tensor->xz})
            places.emplace_back(std::string(name) + symmetric_component_names[c++], value);
    }
    for (std::size_t s = 0; s < point.old.state.size(); ++s)
        places.emplace_back(material.state_variables()[s].name, &point.old.state[s]);
    places.emplace_back("suction", &point.suction);
    places.emplace_back("saturation", &point.saturation);
    places.emplace_back("time step", &time_step);
    using Limits = std::numeric_limits<double>;
    for (const auto& [name, place] : places)
        for (const double value : {Limits::quiet_NaN(), Limits::infinity(), -Limits::infinity()}) {
            const double before = std::exchange(*place, value);
            const std::string fault = detail::hostile_fault(material, point, time_step, range, false);
            *place = before;
            if (!fault.empty())
                return {sentence("hostile input: ", name, " = ", value, " ", fault)};
        }
    return {};
}

/// When one point of a block fails, the status names that point.
inline Faults check_failure_names_bond(const Material& material, const Range& range = {})
{
    const MaterialPoint start =
        starting_point(material, range, SymmetricTensor<double>::isotropic(-range.pressures.front()));
    const std::vector<BlockPoint> sound(3 * pack_width, block_point(start, {}));
    for (const std::size_t bond : {std::size_t(0), pack_width - 1, pack_width, 3 * pack_width - 1}) {
        std::vector<BlockPoint> points = sound;
        points[bond].strain_increment.xy = std::numeric_limits<double>::quiet_NaN();
        Block block(material, points);
        if (const MaterialStatus status = block.update(range.time_step); !status.converged && status.bond != bond)
            return {sentence("failure: not-a-number as the strain of bond ", bond, " is reported as a failure of bond ",
                             status.bond)};
    }
    return {};
}

} // namespace periporo::kit
