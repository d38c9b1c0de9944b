// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The mark of a folder that holds a run: the lock of the run in progress, and the names of what runs wrote into it.
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

namespace periporo {

/// The file that marks a folder of a run. Its first line names the process that wrote into the folder last; a line for
/// each file or folder follows that a writer of a run makes there. The system locks it while a run goes on, and frees
/// it at the end of the process by any cause.
inline constexpr const char* run_mark = "periporo.run";

/// A folder that a run cannot write to: the user chooses another one.
class FolderError : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// Holds the lock of a folder. A folder in which nothing was written is left as it was found.
class FolderLock {
public:
    /// Makes the folder and its mark where they are missing, and locks it.
    /// @throws FolderError with the number of the process when another run holds the lock, or with the system's reason
    /// when the folder cannot be written
    explicit FolderLock(std::filesystem::path folder);
    ~FolderLock();
    FolderLock(FolderLock&& other) noexcept;
    FolderLock& operator=(FolderLock&&) = delete;

private:
    std::filesystem::path folder_;
    bool made_folder_ = false;
    int descriptor_ = -1;
};

/// Throws as the constructor of FolderLock when a run goes on in the folder. Changes nothing.
void require_no_run_in(const std::filesystem::path& folder);

/// Does the folder hold what a run of this program left behind, as far as it came?
bool holds_run(const std::filesystem::path& folder);

/// Everything in the folder that a run wrote: files of the program, and of the writers that its runs had. What comes
/// first in the list is to be deleted first: without its checkpoint a run cannot be resumed by halves.
std::vector<std::string> names_of_run(const std::filesystem::path& folder);

/// Everything else in the folder, by name.
std::vector<std::string> foreign_names(const std::filesystem::path& folder);

/// Notes the names that the writers of a run make in its folder, before they make them.
/// @param fresh the run does not go on with an earlier one
/// @throws FolderError when a name is no plain name, or when a fresh run would write over a file of somebody else
void note_names(const std::filesystem::path& folder, const std::vector<std::string>& names, bool fresh);

} // namespace periporo
