// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The arguments of a UMAT.
#include "umat_call.hpp"

#include "utility_routines.hpp"

namespace periporo::abaqus {

namespace {

/// UMAT orders 11 22 33 12 13 23, the framework xx yy zz xy yz xz.
constexpr std::array<std::size_t, 6> component_of = {0, 1, 2, 3, 5, 4};
constexpr double large_step_ratio = 1e36; // PNEWDT when the routine asks for nothing

/// The arguments of one call but STATEV and PROPS. All are copies: some routines write on what they are told not to.
struct Arguments {
    Arguments(const RoutineSettings& settings, const Bond& bond, double the_time_step)
        : time_step(the_time_step),
          temperature(settings.temperature), fields{bond.suction() / settings.stress_unit, bond.saturation()},
          length(settings.characteristic_length), name(settings.name),
          state_count(static_cast<int>(settings.state_count)),
          property_count(static_cast<int>(settings.properties.size()))
    {
        for (std::size_t n = 0; n < 6; ++n) {
            stress[n] = bond.stress(component_of[n]) / settings.stress_unit;
            strain_increment[n] = (n < 3 ? 1.0 : 2.0) * bond.strain_increment(component_of[n]);
        }
        strain.fill(settings.unknown);
        place.fill(settings.unknown);
        times.fill(settings.unknown + time_step);
        for (std::array<double, 9>* gradient : {&gradient_old, &gradient_new}) {
            gradient->fill(settings.unknown);
            for (const std::size_t diagonal : {0, 4, 8})
                (*gradient)[diagonal] = settings.unknown_one;
        }
    }

    std::array<double, 6> stress{}, strain{}, strain_increment{};
    double time_step;
    std::array<double, 2> times{};
    double temperature, temperature_increment = 0.0;
    std::array<double, 2> fields, field_increments{};
    double length;
    std::array<double, 3> place{};
    std::array<double, 9> rotation = {1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0}, gradient_old{}, gradient_new{};
    std::array<char, 80> name;
    int direct = 3, shear = 3, tensor = 6, state_count, property_count;
    int element = 1, point = 1, layer = 1, section_point = 1;
    std::array<int, 4> step = {1, 0, 1, 0}; // the first; no procedure of Abaqus; large deformation; no perturbation
    int increment = 2;                      // the routine is never told that it is called for the first time
    // What the routine may define besides stress and state. Of this only PNEWDT is looked at.
    std::array<double, 36> stiffness{};
    std::array<double, 6> stress_by_temperature{}, heat_by_strain{};
    double elastic_energy = 0.0, plastic_energy = 0.0, creep_energy = 0.0, heat = 0.0, heat_by_temperature = 0.0;
    double step_ratio = large_step_ratio;
};

bool all_finite(const double* values, std::size_t count)
{
    return std::all_of(values, values + count, [](double value) { return std::isfinite(value); });
}

} // namespace

void UmatCall::advance(const MaterialBatch& batch)
{
    for (bond = 0; bond < batch.packs * pack_width; ++bond) {
        if (!is_active(batch, bond))
            continue;
        failure = advance_bond(Bond(batch, settings().state_count, bond), batch.time_step);
        if (failure != RoutineFailure::none)
            return;
    }
}

RoutineFailure UmatCall::advance_bond(const Bond& member, double time_step)
{
    const std::size_t states = settings().state_count;
    double* const state = state_.resize(states);
    for (std::size_t s = 0; s < states; ++s)
        state[s] = member.state(s);
    Arguments a(settings(), member, time_step);

    routine_(a.stress.data(), state, a.stiffness.data(), &a.elastic_energy, &a.plastic_energy, &a.creep_energy, &a.heat,
             a.stress_by_temperature.data(), a.heat_by_strain.data(), &a.heat_by_temperature, a.strain.data(),
             a.strain_increment.data(), a.times.data(), &a.time_step, &a.temperature, &a.temperature_increment,
             a.fields.data(), a.field_increments.data(), a.name.data(), &a.direct, &a.shear, &a.tensor, &a.state_count,
             properties(), &a.property_count, a.place.data(), a.rotation.data(), &a.step_ratio, &a.length,
             a.gradient_old.data(), a.gradient_new.data(), &a.element, &a.point, &a.layer, &a.section_point,
             a.step.data(), &a.increment, a.name.size());

    if (!reported_error().empty())
        return RoutineFailure::reported;
    if (state_.overrun())
        return RoutineFailure::wrote_past_state;
    if (a.step_ratio < 1.0)
        return RoutineFailure::smaller_step;
    if (!all_finite(a.stress.data(), a.stress.size()) || !all_finite(state, states))
        return RoutineFailure::not_finite;
    for (std::size_t n = 0; n < 6; ++n)
        member.stress(component_of[n]) = a.stress[n] * settings().stress_unit;
    for (std::size_t s = 0; s < states; ++s)
        member.state(s) = state[s];
    return RoutineFailure::none;
}

} // namespace periporo::abaqus
