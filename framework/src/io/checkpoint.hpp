// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The checkpoints of a run: the newest and the one before it, so that at every instant one of them is sound.
#pragma once

#include "io/archive.hpp"

#include <filesystem>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace periporo {

/// A checkpoint that this case cannot go on from: the user's input is wrong.
class ForeignCheckpoint : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// Names of the files in the folder of a run.
inline constexpr const char* checkpoint_name = "checkpoint.bin";
inline constexpr const char* previous_checkpoint_name = "checkpoint.previous.bin";
inline constexpr const char* damaged_checkpoint_name = "checkpoint.damaged.bin";

/// Writes a checkpoint aside, brings it to the disk, and renames the newest to the previous one and it to the newest.
/// @param resolved_case the whole case, by which a checkpoint is known
/// @param save adds all that the run needs to go on
/// @param in_place is called when a resume finds the checkpoint, also when an error of the system follows
/// @throws FileError naming the file and the reason
void write_checkpoint(
    const std::filesystem::path& folder, const std::string& resolved_case,
    const std::function<void(ArchiveWriter&)>& save, const std::function<void()>& in_place = [] {});

/// Is there a checkpoint in the folder, sound or not?
bool has_checkpoint(const std::filesystem::path& folder);

/// The newest sound checkpoint of a folder.
struct FoundCheckpoint {
    std::optional<ArchiveReader> archive; ///< none: there is no checkpoint
    std::vector<std::string> refused;     ///< what is wrong with newer ones, with their names
    std::vector<std::string> differences; ///< of its case, without influence on the results
};

/// Changes nothing.
/// @throws ForeignCheckpoint when the checkpoint was written by another version of the program, or for another case: it
/// names the first key that differs
/// @throws ArchiveError naming both files when both are damaged
/// @throws FolderError when the system does not let the newest one be read
FoundCheckpoint find_checkpoint(const std::filesystem::path& folder, const std::string& resolved_case);

/// Renames a newest checkpoint that was refused, so that it does not take the place of the previous, sound one.
void set_damaged_checkpoint_aside(const std::filesystem::path& folder);

/// Removes the checkpoints of a run that is complete.
void remove_checkpoints(const std::filesystem::path& folder);

} // namespace periporo
