// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Checkpoints of a run: the hashes of its inputs, its state and its report.
#include "scheduler/run_checkpoints.hpp"

#include "io/checkpoint.hpp"
#include "periporo/file.hpp"
#include "scheduler/guards.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <stdexcept>
#include <string>

namespace periporo {

RunCheckpoints::RunCheckpoints(RunState& run, RunReport& report, const InputHashes& inputs, const RunOptions& options,
                               spdlog::logger& log)
    : run_(run), report_(report), inputs_(inputs), options_(options), log_(log), last_(std::chrono::steady_clock::now())
{
}

void RunCheckpoints::restore(ArchiveReader& checkpoint)
{
    constexpr std::size_t longest_inputs = std::size_t{64} << 20; // [bytes]
    std::string text;
    checkpoint("inputs", at_most(text, longest_inputs));
    const InputHashes before = InputHashes::from_text(text);
    if (before.text() != text)
        throw ArchiveError(fmt::format("\"inputs\" in {} is no list of hashes", checkpoint.file().string()));
    if (const std::string difference = inputs_.difference_from(before); !difference.empty())
        throw ForeignCheckpoint(fmt::format("{} cannot go on: {}; bring back the file as it was, or start anew with "
                                            "--overwrite",
                                            checkpoint.file().string(), difference));
    run_.restore(checkpoint);
    report_.restore(checkpoint);
    run_.outputs.expect_earlier(options_.directory, options_.without_lost);
    const RunPosition& at = run_.position;
    last_step_ = at.step;
    log_.info("resumed {} stage '{}' at step {}, time {:.6g} s",
              at.stage == run_.description.stages.size() ? "behind"
              : at.begun                                 ? "in"
                                                         : "before",
              run_.current_stage().name, at.step, at.time);
}

bool RunCheckpoints::due() const
{
    const double every = run_.description.checkpoint_every;
    const std::chrono::duration<double> interval(std::max(every, 20.0 * took_.count()));
    return every == 0.0 || std::chrono::steady_clock::now() - last_ > interval;
}

void RunCheckpoints::write()
{
    const auto began = std::chrono::steady_clock::now();
    if (const std::string lost = lost_point(run_.model); !lost.empty())
        throw std::runtime_error(lost);
    run_.outputs.flush(run_.position.step);
    store();
    start_clock();
    took_ = last_ - began;
}

void RunCheckpoints::write_if_possible()
{
    run_.outputs.flush(run_.position.step);
    try {
        store();
    } catch (const FileError& error) {
        log_.warn("{}; the run goes on, and the last checkpoint stays", error.what());
    }
}

void RunCheckpoints::store()
{
    write_checkpoint(
        options_.directory, run_.description.resolved,
        [this](ArchiveWriter& archive) {
            archive("inputs", inputs_.text());
            run_.save(archive);
            report_.save(archive);
        },
        [this] { last_step_ = run_.position.step; });
}

} // namespace periporo
