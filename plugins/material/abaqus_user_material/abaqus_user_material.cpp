// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The plugin material "abaqus_user_material".
#include "abaqus_user_material.hpp"

#include "umat_call.hpp"
#include "utility_routines.hpp"
#include "vumat_call.hpp"

#include "periporo/material_law.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <limits>
#include <stdexcept>
#include <utility>

namespace periporo {

namespace {

void check_length(const char* name, std::size_t length, std::size_t state_count)
{
    if (length != state_count)
        throw std::invalid_argument(
            fmt::format("{} has {} members, but state_variables is {}", name, length, state_count));
}

std::vector<StateVariable> make_variables(const Parameters& parameters)
{
    const auto count = static_cast<std::size_t>(parameters.integer("state_variables"));
    std::vector<StateVariable> variables(count);
    for (std::size_t s = 0; s < count; ++s)
        variables[s] = {fmt::format("state_{}", s + 1), "-", fmt::format("STATEV({}) of the routine", s + 1)};
    if (parameters.has("state_names")) {
        const std::vector<std::string>& names = parameters.text_list("state_names");
        check_length("state_names", names.size(), count);
        for (std::size_t s = 0; s < count; ++s) {
            if (std::find(names.begin(), names.begin() + static_cast<std::ptrdiff_t>(s), names[s]) !=
                names.begin() + static_cast<std::ptrdiff_t>(s))
                throw std::invalid_argument(fmt::format("state_names has \"{}\" twice", names[s]));
            variables[s].name = names[s];
        }
    }
    if (parameters.has("initial_state")) {
        const std::vector<double>& initial = parameters.real_list("initial_state");
        check_length("initial_state", initial.size(), count);
        for (std::size_t s = 0; s < count; ++s)
            variables[s].initial = initial[s];
    }
    if (parameters.has("states_of_point"))
        for (const std::string& name : parameters.text_list("states_of_point")) {
            const auto variable = std::find_if(variables.begin(), variables.end(),
                                               [&](const StateVariable& candidate) { return candidate.name == name; });
            if (variable == variables.end())
                throw std::invalid_argument(fmt::format("states_of_point: no state variable is named \"{}\"", name));
            variable->of_point = true;
        }
    return variables;
}

abaqus::RoutineSettings make_settings(const Parameters& parameters)
{
    abaqus::RoutineSettings settings;
    settings.properties = parameters.real_list("properties");
    settings.state_count = static_cast<std::size_t>(parameters.integer("state_variables"));
    const std::string& name = parameters.text("name");
    if (name.size() > settings.name.size())
        throw std::invalid_argument(fmt::format("name has more than {} characters", settings.name.size()));
    settings.name.fill(' ');
    std::copy(name.begin(), name.end(), settings.name.begin());
    settings.stress_unit = parameters.real("stress_unit");
    if (parameters.text("unknown_quantities") == "not_a_number")
        settings.unknown = settings.unknown_one = std::numeric_limits<double>::quiet_NaN();
    settings.temperature = parameters.has("temperature") ? parameters.real("temperature") : settings.unknown;
    settings.characteristic_length =
        parameters.has("characteristic_length") ? parameters.real("characteristic_length") : settings.unknown_one;
    return settings;
}

std::string failure_text(abaqus::RoutineFailure failure)
{
    switch (failure) {
    case abaqus::RoutineFailure::smaller_step:
        return "asked for a smaller time step (PNEWDT < 1); the time step of a run is set by safety or step in [time]";
    case abaqus::RoutineFailure::not_finite:
        return "gave a stress or a state variable that is not a finite number; one that uses total strain, deformation "
               "gradient, time, place, or properties that are not given meets not-a-number there";
    case abaqus::RoutineFailure::wrote_past_state:
        return "wrote past the end of its state variables; state_variables is too small";
    case abaqus::RoutineFailure::reported: // has a text of its own
    case abaqus::RoutineFailure::none:
        break;
    }
    return {};
}

} // namespace

std::vector<Parameter> AbaqusUserMaterial::parameters()
{
    return {
        Parameter::text("library", "Shared library: an absolute path, or a file name that is searched in "
                                   "LD_LIBRARY_PATH and the folders of the system"),
        Parameter::text("interface", "Which of the two interfaces the routine has").one_of({"umat", "vumat"}),
        Parameter::text("symbol", "Symbol of the routine, by default umat_ or vumat_, as Fortran compilers name it")
            .optional(),
        Parameter::text("name", "Name of the material, CMNAME").by_default("USER_MATERIAL"),
        Parameter::real_list("properties", dimension::none, 0, "Constants PROPS, in the units of the routine"),
        Parameter::integer("state_variables", "Number of state variables, NSTATV").at_least(0),
        Parameter::real_list("initial_state", dimension::none, 0, "State variables at the start, by default 0")
            .optional(),
        Parameter::text_list("state_names", 0, "Names of the state variables, by default state_1, state_2 and on")
            .optional(),
        Parameter::text_list("states_of_point", 0,
                             "Those that are properties of the place and not of a direction, as void ratio is")
            .optional(),
        Parameter::real("bulk_modulus", dimension::pressure,
                        "Elastic bulk modulus K that bounds the law's, for the stable step and the elastic stage")
            .above(0.0),
        Parameter::real("shear_modulus", dimension::pressure, "Elastic shear modulus G that bounds the law's")
            .above(0.0),
        Parameter::real("stress_unit", dimension::pressure, "Unit of stress in which the routine computes")
            .above(0.0)
            .by_default(1.0),
        Parameter::real("temperature", dimension::none, "TEMP, in the unit of the routine; without it unknown")
            .optional(),
        Parameter::real("characteristic_length", dimension::length,
                        "CELENT, as of a law with fracture energy; without it unknown")
            .above(0.0)
            .optional(),
        Parameter::text("unknown_quantities",
                        "What stands for total strain, deformation gradient, time and place, which are not known: "
                        "not-a-number, so that a law that uses them fails, or the values of an undeformed body")
            .one_of({"not_a_number", "undeformed"})
            .by_default("not_a_number"),
        Parameter::boolean("thread_safe", "Whether several threads may call the library at once").by_default(false)};
}

AbaqusUserMaterial::AbaqusUserMaterial(const Parameters& parameters)
    : bulk_modulus_(parameters.real("bulk_modulus")), shear_modulus_(parameters.real("shear_modulus")),
      variables_(make_variables(parameters)), settings_(make_settings(parameters)),
      thread_safe_(parameters.boolean("thread_safe")),
      library_(abaqus::RoutineLibrary::load(parameters.text("library")))
{
    const std::string& interface = parameters.text("interface");
    const std::string symbol = parameters.has("symbol") ? parameters.text("symbol") : interface + "_";
    routine_name_ = fmt::format("{} of {}", symbol, parameters.text("library"));
    if (interface == "umat")
        make_call_ = [this, routine = library_.routine<abaqus::Umat>(symbol, interface)] {
            return std::make_unique<abaqus::UmatCall>(routine, settings_);
        };
    else
        make_call_ = [this, routine = library_.routine<abaqus::Vumat>(symbol, interface)] {
            return std::make_unique<abaqus::VumatCall>(routine, settings_);
        };
}

std::unique_ptr<AbaqusUserMaterial::Caller> AbaqusUserMaterial::borrow_caller() const
{
    {
        const std::lock_guard alone(idle_mutex_);
        if (!idle_.empty()) {
            std::unique_ptr<Caller> caller = std::move(idle_.back());
            idle_.pop_back();
            return caller;
        }
    }
    auto caller = std::make_unique<Caller>();
    caller->call = make_call_();
    return caller;
}

void AbaqusUserMaterial::give_back(std::unique_ptr<Caller> caller) const
{
    const std::lock_guard alone(idle_mutex_);
    idle_.push_back(std::move(caller));
}

MaterialStatus AbaqusUserMaterial::failed(std::size_t bond, const std::string& reason) const
{
    return {false, bond, library_.keep(fmt::format("{} {}", routine_name_, reason))};
}

MaterialStatus AbaqusUserMaterial::update(const MaterialBatch& batch) const
{
    if (batch.response == MaterialResponse::elastic) {
        update_elastically(batch);
        return {};
    }
    std::unique_ptr<Caller> caller;
    try {
        caller = borrow_caller();
    } catch (const std::exception& error) {
        return failed(0, fmt::format("cannot be called: {}", error.what()));
    }
    const MaterialStatus status = call_routine(*caller, batch);
    give_back(std::move(caller));
    return status;
}

void AbaqusUserMaterial::update_elastically(const MaterialBatch& batch) const
{
    for (std::size_t b = 0; b < batch.packs * pack_width; ++b) {
        if (!abaqus::is_active(batch, b))
            continue;
        const abaqus::Bond bond(batch, settings_.state_count, b);
        const auto tensor = [](auto component) {
            return SymmetricTensor<double>{component(0), component(1), component(2),
                                           component(3), component(4), component(5)};
        };
        const SymmetricTensor<double> stress = elastic_stress(
            tensor([&](std::size_t c) { return bond.stress(c); }),
            tensor([&](std::size_t c) { return bond.strain_increment(c); }), bulk_modulus_, shear_modulus_);
        std::size_t c = 0;
        for (const double component : components(stress))
            bond.stress(c++) = component;
    }
}

MaterialStatus AbaqusUserMaterial::call_routine(Caller& caller, const MaterialBatch& batch) const
{
    struct Task {
        abaqus::RoutineCall& call;
        const MaterialBatch& batch;
    } task{*caller.call, batch};
    const auto advance = [](void* argument) {
        const Task& the_task = *static_cast<Task*>(argument);
        the_task.call.advance(the_task.batch);
    };
    std::unique_lock alone(library_.mutex(), std::defer_lock);
    if (!thread_safe_)
        alone.lock();
    abaqus::forget_reported_error();
    task.call.failure = abaqus::RoutineFailure::none;
    const abaqus::SideStack::Ending ending = caller.stack.run(advance, &task);

    const std::string& error = abaqus::reported_error();
    if (ending == abaqus::SideStack::Ending::left)
        return failed(task.call.bond, error.empty() ? "called XIT" : "stopped with the error: " + error);
    if (ending == abaqus::SideStack::Ending::threw)
        return failed(task.call.bond, "threw an exception of C++");
    if (!error.empty())
        return failed(task.call.bond, "reported the error: " + error);
    if (task.call.failure != abaqus::RoutineFailure::none)
        return failed(task.call.bond, failure_text(task.call.failure));
    return {};
}

void AbaqusUserMaterial::initialize(const MaterialBatch& batch, double) const
{
    const std::size_t rows = 6 + variables_.size();
    for (std::size_t p = 0; p < batch.packs; ++p)
        for (std::size_t s = 0; s < variables_.size(); ++s)
            std::fill_n(batch.bonds + (p * rows + 6 + s) * pack_width, pack_width, variables_[s].initial);
}

} // namespace periporo

PERIPORO_PLUGIN(periporo::PluginKind::material, periporo::AbaqusUserMaterial, "abaqus_user_material",
                "The law of an Abaqus UMAT or VUMAT in a shared library of the user")
