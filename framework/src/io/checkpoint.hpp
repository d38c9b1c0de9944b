// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Everything a run needs to go on as if it had never stopped, to the last bit.
#pragma once

#include "contact/contact_forces.hpp"
#include "model/model.hpp"
#include "time/dynamics.hpp"
#include "time/rest.hpp"
#include "time/stable_step.hpp"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

namespace periporo {

/// Where a run stands in its stages.
struct RunPosition {
    std::uint64_t stage = 0;
    std::uint64_t stage_step = 0;           ///< steps done in the stage
    std::uint64_t step = 0;                 ///< steps done in all stages
    double time = 0.0;                      ///< since the first dynamic stage began [s]
    double stage_start = 0.0;               ///< `time` when the stage began [s]
    double time_step = 0.0;                 ///< [s]
    std::uint64_t next_history = 0;         ///< index of the next history row
    std::vector<std::uint64_t> next_output; ///< for each output, index of its next snapshot
    double wall_seconds = 0.0;              ///< spent so far
    bool ledger_open = false;
    double error_before = 0.0; ///< of the energy ledger when the last quasi-static stage ended [J]
    RestCriterion::State rest; ///< of the stage
    std::string stage_reports; ///< JSON of the stages that are done
    std::string inputs;        ///< InputHashes::text() of the files that the run has read
};

/// A checkpoint that this case cannot go on from: the user's input is wrong.
class ForeignCheckpoint : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

struct CheckpointParts {
    Model& model;
    const ForceState& force_state;
    ContactForces& contact;
    Dynamics& dynamics;
    FrequencyEstimate& frequency;
    RunPosition& position;
    WaterCourse& water;
};

/// Writes `file` aside and renames it.
void write_checkpoint(const std::filesystem::path& file, const CheckpointParts& parts,
                      const std::string& resolved_case);

/// Restores a model that was built from the same case; constraints of the stage remain to be set.
/// @param enter_stage gives the model the images and obstacles of a stage
/// @param contact_slack as for ContactForces::find_candidates [m]
/// @throws ForeignCheckpoint when it was written by another case or another version of the program, std::runtime_error
/// when it cannot be read.
void read_checkpoint(const std::filesystem::path& file, const CheckpointParts& parts, const std::string& resolved_case,
                     double contact_slack, const std::function<void(std::uint64_t stage)>& enter_stage);

} // namespace periporo
