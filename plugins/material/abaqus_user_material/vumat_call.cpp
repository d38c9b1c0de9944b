// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The arguments of a VUMAT. It orders components 11 22 33 12 23 13 and has tensor shear, as the framework.
#include "vumat_call.hpp"

#include "utility_routines.hpp"

namespace periporo::abaqus {

VumatCall::VumatCall(Vumat* routine, const RoutineSettings& settings)
    : RoutineCall(settings), routine_(routine), state_new_(largest_block * settings.state_count)
{
    block_.reserve(largest_block);
}

void VumatCall::advance(const MaterialBatch& batch)
{
    const std::size_t bonds = batch.packs * pack_width;
    for (std::size_t next = 0; next < bonds;) {
        block_.clear();
        for (; next < bonds && block_.size() < largest_block; ++next)
            if (is_active(batch, next))
                block_.push_back(next);
        if (block_.empty())
            return;
        bond = block_.front();
        failure = advance_block(batch);
        if (failure != RoutineFailure::none)
            return;
    }
}

RoutineFailure VumatCall::advance_block(const MaterialBatch& batch)
{
    const std::size_t count = block_.size();
    const std::size_t states = settings().state_count;
    stress_old_.resize(6 * count);
    strain_increment_.resize(6 * count);
    state_old_.resize(states * count);
    for (std::size_t k = 0; k < count; ++k) {
        const Bond member(batch, states, block_[k]);
        for (std::size_t c = 0; c < 6; ++c) {
            stress_old_[c * count + k] = member.stress(c) / settings().stress_unit;
            strain_increment_[c * count + k] = member.strain_increment(c);
        }
        for (std::size_t s = 0; s < states; ++s)
            state_old_[s * count + k] = member.state(s);
    }
    stress_new_ = stress_old_;
    std::copy(state_old_.begin(), state_old_.end(), state_new_.resize(states * count));
    fill_surroundings(batch);
    call(batch.time_step);
    return store(batch);
}

void VumatCall::fill_surroundings(const MaterialBatch& batch)
{
    const std::size_t count = block_.size();
    place_.assign(3 * count, settings().unknown);
    length_.assign(count, settings().characteristic_length);
    density_.assign(count, settings().unknown_one);
    spin_.assign(3 * count, 0.0);
    temperature_old_.assign(count, settings().temperature);
    temperature_new_ = temperature_old_;
    fields_old_.resize(2 * count);
    for (std::size_t k = 0; k < count; ++k) {
        fields_old_[k] = batch.suction[block_[k]] / settings().stress_unit;
        fields_old_[count + k] = batch.saturation[block_[k]];
    }
    fields_new_ = fields_old_;
    // the components on the diagonal come first
    stretch_old_.assign(6 * count, settings().unknown);
    std::fill_n(stretch_old_.begin(), 3 * count, settings().unknown_one);
    stretch_new_ = stretch_old_;
    gradient_old_.assign(9 * count, settings().unknown);
    std::fill_n(gradient_old_.begin(), 3 * count, settings().unknown_one);
    gradient_new_ = gradient_old_;
    for (std::vector<double>* energy : {&internal_old_, &internal_new_, &inelastic_old_, &inelastic_new_})
        energy->assign(count, 0.0);
    time_steps_.assign(2 * count + 1, batch.time_step);
    block_numbers_.assign(4 + count, 1); // point, layer, section point, elements
    block_numbers_[0] = static_cast<int>(count);
    information_.assign(5 + count, 1);     // annealing, point, layer, section point, effective moduli, elements
    information_[0] = information_[4] = 0; // no annealing; no effective moduli are asked for
}

void VumatCall::call(double time_step)
{
    int direct = 3, shear = 3, fields = 2;
    int states = static_cast<int>(settings().state_count);
    int property_count = static_cast<int>(settings().properties.size());
    // Never 0, which would announce the elastic check that Abaqus makes before the first increment.
    double step_time = settings().unknown + time_step, total_time = step_time;
    std::array<char, 80> name = settings().name;
    routine_(block_numbers_.data(), &direct, &shear, &states, &fields, &property_count, information_.data(), &step_time,
             &total_time, time_steps_.data(), name.data(), place_.data(), length_.data(), properties(), density_.data(),
             strain_increment_.data(), spin_.data(), temperature_old_.data(), stretch_old_.data(), gradient_old_.data(),
             fields_old_.data(), stress_old_.data(), state_old_.data(), internal_old_.data(), inelastic_old_.data(),
             temperature_new_.data(), stretch_new_.data(), gradient_new_.data(), fields_new_.data(), stress_new_.data(),
             state_new_.data(), internal_new_.data(), inelastic_new_.data(), name.size());
}

RoutineFailure VumatCall::store(const MaterialBatch& batch)
{
    if (!reported_error().empty())
        return RoutineFailure::reported;
    if (state_new_.overrun())
        return RoutineFailure::wrote_past_state;
    const std::size_t count = block_.size();
    const std::size_t states = settings().state_count;
    const double* const state_new = state_new_.data();
    for (std::size_t k = 0; k < count; ++k) {
        bool finite = true;
        for (std::size_t c = 0; c < 6; ++c)
            finite = finite && std::isfinite(stress_new_[c * count + k]);
        for (std::size_t s = 0; s < states; ++s)
            finite = finite && std::isfinite(state_new[s * count + k]);
        if (!finite) {
            bond = block_[k];
            return RoutineFailure::not_finite;
        }
        const Bond member(batch, states, block_[k]);
        for (std::size_t c = 0; c < 6; ++c)
            member.stress(c) = stress_new_[c * count + k] * settings().stress_unit;
        for (std::size_t s = 0; s < states; ++s)
            member.state(s) = state_new[s * count + k];
    }
    return RoutineFailure::none;
}

} // namespace periporo::abaqus
