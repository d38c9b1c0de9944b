// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// What leaves the model at a snapshot: fields with unit and meaning, and the columns of the history.
#pragma once

#include "model/model.hpp"
#include "operator/force_state.hpp"
#include "periporo/output.hpp"
#include "time/dynamics.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace periporo {

/// Holds the values of fields that the model does not keep as arrays, and the views that writers are shown.
class SnapshotFields {
public:
    /// Fields of the model as it is. The views hold until the next call or until the model changes.
    const std::vector<FieldView>& collect(const Model& model, const ForceState& force_state);

private:
    void add_real(std::string name, std::string unit, std::string description, std::size_t components,
                  std::vector<double> values);
    void add_integer(std::string name, std::string description, std::vector<std::int64_t> values);
    /// Volume, density and porosity of the points.
    void add_volumes(const Model& model);

    std::vector<std::vector<double>> reals_;
    std::vector<std::vector<std::int64_t>> integers_;
    std::vector<FieldView> fields_;
};

/// Columns of every history row, and the row itself in the same order; obstacles add theirs.
std::vector<HistoryColumn> history_columns(const Model& model);
/// Front and height are those of what stands on the ground, as far as there is a ground.
std::vector<double> history_row(const Model& model, const Dynamics& dynamics, double time, double time_step);

} // namespace periporo
