// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Writes, finds and removes checkpoints; what they hold is their owners' business.
#include "io/checkpoint.hpp"

#include "io/case_difference.hpp"
#include "periporo/file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace periporo {
namespace {

namespace fs = std::filesystem;

/// To be counted up whenever a checkpoint needs something that it did not hold before.
const std::string format = "periporo checkpoint 10";
/// The name of checkpoints up to format 7.
constexpr const char* old_name = "checkpoint.h5";
constexpr std::size_t longest_case = std::size_t{64} << 20; ///< [bytes]

[[noreturn]] void refuse_version(const fs::path& file)
{
    throw ForeignCheckpoint(fmt::format("{} was written by another version of the program; start anew with "
                                        "--overwrite, or go on with the program that wrote it",
                                        file.string()));
}

/// @throws ForeignCheckpoint
void require_same_run(ArchiveReader& archive, const std::string& resolved_case)
{
    std::string written_format, written_case;
    if (archive.has("format"))
        archive("format", at_most(written_format, 100));
    if (written_format != format)
        refuse_version(archive.file());
    archive("case", at_most(written_case, longest_case));
    if (written_case != resolved_case)
        throw ForeignCheckpoint(fmt::format("{} was written by another case or with other --set values: {}; run the "
                                            "case that it was started with, or start anew with --overwrite",
                                            archive.file().string(), case_difference(written_case, resolved_case)));
}

} // namespace

void write_checkpoint(const fs::path& folder, const std::string& resolved_case,
                      const std::function<void(ArchiveWriter&)>& save)
{
    ArchiveWriter archive(folder / checkpoint_name);
    archive("format", format);
    archive("case", resolved_case);
    save(archive);
    archive.commit(folder / previous_checkpoint_name);
}

bool has_checkpoint(const fs::path& folder)
{
    return fs::exists(folder / checkpoint_name) || fs::exists(folder / previous_checkpoint_name) ||
           fs::exists(folder / old_name);
}

FoundCheckpoint find_checkpoint(const fs::path& folder, const std::string& resolved_case)
{
    FoundCheckpoint found;
    for (const char* name : {checkpoint_name, previous_checkpoint_name}) {
        if (!fs::exists(folder / name))
            continue;
        try {
            ArchiveReader archive(folder / name);
            require_same_run(archive, resolved_case);
            found.archive = std::move(archive);
            return found;
        } catch (const ArchiveError& error) {
            found.refused.emplace_back(error.what());
        }
    }
    if (!found.refused.empty())
        throw ArchiveError(
            fmt::format("no checkpoint can be used: {}; start anew with --overwrite", fmt::join(found.refused, "; ")));
    if (fs::exists(folder / old_name))
        refuse_version(folder / old_name);
    return found;
}

void set_damaged_checkpoint_aside(const fs::path& folder)
{
    rename_file(folder / checkpoint_name, folder / damaged_checkpoint_name);
}

void remove_checkpoints(const fs::path& folder)
{
    for (const char* name : {checkpoint_name, previous_checkpoint_name, damaged_checkpoint_name})
        remove_file(folder / name);
    remove_file(part_of(folder / checkpoint_name)); // of a run that was killed while it wrote one
}

} // namespace periporo
