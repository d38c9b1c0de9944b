// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The position of a run in its stages.
#pragma once

#include "case/description.hpp"
#include "io/archive.hpp"
#include "time/rest.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace periporo {

struct RunPosition {
    std::uint64_t stage = 0;
    bool begun = false;           ///< has the stage begun? If not, all before it have ended
    std::uint64_t stage_step = 0; ///< steps done in the stage
    std::uint64_t step = 0;       ///< steps done in all stages
    double time = 0.0;            ///< since the first dynamic stage began [s]
    double stage_start = 0.0;     ///< `time` when the stage began [s]
    double time_step = 0.0;       ///< [s]
    bool ledger_open = false;
    double error_before = 0.0;   ///< of the energy ledger when the last quasi-static stage ended [J]
    std::uint64_t estimates = 0; ///< of the stable step
    RestCriterion::State rest;   ///< of the stage

    /// The stage whose images and obstacles the model has: the present one, or the last one that ended.
    std::uint64_t stage_of_model() const { return begun || stage == 0 ? stage : stage - 1; }

    template <class Self, class Visit>
    static void members(Self& self, Visit& visit, std::size_t points)
    {
        visit("stage", self.stage);
        visit("begun", self.begun);
        visit("stage_step", self.stage_step);
        visit("step", self.step);
        visit("time", self.time);
        visit("stage_start", self.stage_start);
        visit("time_step", self.time_step);
        visit("ledger_open", self.ledger_open);
        visit("error_before", self.error_before);
        visit("estimates", self.estimates);
        visit.part("rest", self.rest, points);
    }
    /// @throws std::runtime_error when no run of these stages can stand there between two steps
    void check(const std::vector<StageDescription>& stages) const;
};

} // namespace periporo
