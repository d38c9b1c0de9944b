// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// A material whose law is a UMAT or VUMAT in a shared library of the user.
#pragma once

#include "routine_call.hpp"
#include "routine_library.hpp"
#include "side_stack.hpp"

#include "periporo/material.hpp"

#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace periporo {

/// README.md beside this file says what the routine is given and what is made of what it returns.
class AbaqusUserMaterial final : public Material {
public:
    static std::vector<Parameter> parameters();

    /// @throws std::exception when parameters disagree, or the library does not load or lacks the routine
    explicit AbaqusUserMaterial(const Parameters& parameters);

    const std::vector<StateVariable>& state_variables() const override { return variables_; }
    double bulk_modulus() const override { return bulk_modulus_; }
    double shear_modulus() const override { return shear_modulus_; }
    MaterialStatus update(const MaterialBatch& batch) const override;
    /// The state variables become `initial_state`: the routine knows no overconsolidation ratio.
    void initialize(const MaterialBatch& batch, double overconsolidation_ratio) const override;

private:
    /// What one thread needs to call the routine.
    struct Caller {
        std::unique_ptr<abaqus::RoutineCall> call;
        abaqus::SideStack stack;
    };

    std::unique_ptr<Caller> borrow_caller() const;
    void give_back(std::unique_ptr<Caller> caller) const;
    void update_elastically(const MaterialBatch& batch) const;
    MaterialStatus call_routine(Caller& caller, const MaterialBatch& batch) const;
    /// The status of a failure; the reason begins with the name of the routine.
    MaterialStatus failed(std::size_t bond, const std::string& reason) const;

    double bulk_modulus_;
    double shear_modulus_;
    std::vector<StateVariable> variables_;
    abaqus::RoutineSettings settings_;
    bool thread_safe_;
    abaqus::RoutineLibrary& library_;
    std::string routine_name_; ///< for messages
    std::function<std::unique_ptr<abaqus::RoutineCall>()> make_call_;

    mutable std::mutex idle_mutex_;
    mutable std::vector<std::unique_ptr<Caller>> idle_; ///< callers that no thread uses now
};

} // namespace periporo
