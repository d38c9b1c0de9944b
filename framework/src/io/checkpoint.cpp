// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Writes, finds and removes checkpoints; what they hold is their owners' business.
#include "io/checkpoint.hpp"

#include "io/case_difference.hpp"
#include "io/folder_error.hpp"
#include "periporo/file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

namespace periporo {
namespace {

namespace fs = std::filesystem;

/// To be counted up whenever a checkpoint needs something that it did not hold before.
const std::string format = "periporo checkpoint 13";
/// The name of checkpoints up to format 7.
constexpr const char* old_name = "checkpoint.h5";
constexpr std::size_t longest_case = std::size_t{64} << 20; ///< [bytes]

[[noreturn]] void refuse_version(const fs::path& file)
{
    throw ForeignCheckpoint(fmt::format("{} was written by another version of the program; start anew with "
                                        "--overwrite, or go on with the program that wrote it",
                                        file.string()));
}

/// A checkpoint that the system does not let a run read may be sound: neither is it set aside, nor is an older one
/// used.
/// @throws FolderError
void require_readable(const fs::path& file)
{
    require_regular(file);
    const int descriptor = ::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    if (descriptor < 0 && errno != EIO)
        throw FolderError(FileError("cannot read", file, errno).what());
    if (descriptor >= 0)
        ::close(descriptor);
}

/// Is there an entry of this name? @throws FolderError when the folder cannot be looked into
bool is_there(const fs::path& file)
{
    std::error_code error;
    const bool there = fs::exists(fs::symlink_status(file, error));
    if (error && error != std::errc::no_such_file_or_directory && error != std::errc::not_a_directory)
        throw FolderError(FileError("cannot read", file, error.value()).what());
    return there;
}

/// @return differences of the case without influence on the results
/// @throws ForeignCheckpoint
std::vector<std::string> require_same_run(ArchiveReader& archive, const std::string& resolved_case)
{
    std::string written_format, written_case;
    if (archive.has("format"))
        archive("format", at_most(written_format, 100));
    if (written_format != format)
        refuse_version(archive.file());
    archive("case", at_most(written_case, longest_case));
    if (!give_same_results(written_case, resolved_case))
        throw ForeignCheckpoint(fmt::format("{} was written by another case or with other --set values: {}; run the "
                                            "case that it was started with, or start anew with --overwrite",
                                            archive.file().string(), case_difference(written_case, resolved_case)));
    return differences_without_influence(written_case, resolved_case);
}

} // namespace

void write_checkpoint(const fs::path& folder, const std::string& resolved_case,
                      const std::function<void(ArchiveWriter&)>& save, const std::function<void()>& in_place)
{
    ArchiveWriter archive(folder / checkpoint_name);
    archive("format", format);
    archive("case", resolved_case);
    save(archive);
    try {
        archive.commit(folder / previous_checkpoint_name);
    } catch (...) {
        if (archive.is_in_place())
            in_place();
        throw;
    }
    in_place();
}

bool has_checkpoint(const fs::path& folder)
{
    return is_there(folder / checkpoint_name) || is_there(folder / previous_checkpoint_name) ||
           is_there(folder / old_name);
}

FoundCheckpoint find_checkpoint(const fs::path& folder, const std::string& resolved_case)
{
    FoundCheckpoint found;
    for (const char* name : {checkpoint_name, previous_checkpoint_name}) {
        if (!is_there(folder / name))
            continue;
        require_readable(folder / name);
        try {
            ArchiveReader archive(folder / name);
            found.differences = require_same_run(archive, resolved_case);
            found.archive = std::move(archive);
            return found;
        } catch (const ArchiveError& error) {
            found.refused.emplace_back(error.what());
        }
    }
    if (!found.refused.empty())
        throw ArchiveError(
            fmt::format("no checkpoint can be used: {}; start anew with --overwrite", fmt::join(found.refused, "; ")));
    if (is_there(folder / old_name))
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
