// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The mark of a folder that holds a run: the lock of the run in progress, and the names of what runs wrote into it.
#pragma once

#include <exception>
#include <filesystem>
#include <new>
#include <stdexcept>
#include <string>
#include <vector>

namespace periporo {

/// The file that marks a folder of a run. Its first line names the process that wrote into the folder last; a line for
/// each file or folder follows that a writer of a run makes there. The system locks it, and the folder itself, while a
/// run goes on, and frees both at the end of the process by any cause.
inline constexpr const char* run_mark = "periporo.run";

/// A folder that a run cannot write to: the user chooses another one.
class FolderError : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// Runs `action`, which prepares a folder before the first step: any error but want of memory becomes FolderError.
template <class Action>
void as_fault_of_folder(Action&& action)
{
    try {
        action();
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& error) {
        throw FolderError(error.what());
    }
}

/// Holds the lock of a folder, also when somebody deletes the mark. A folder in which nothing was written is left as it
/// was found.
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
    void lock_folder();
    void lock_mark();
    void close() noexcept;

    std::filesystem::path folder_;
    bool made_folder_ = false;
    int directory_ = -1; ///< descriptor of the folder
    int mark_ = -1;      ///< descriptor of its mark
};

/// Throws as the constructor of FolderLock when a run goes on in the folder. Changes nothing.
void require_no_run_in(const std::filesystem::path& folder);

/// Does the folder hold what a run of this program left behind, as far as it came?
bool holds_run(const std::filesystem::path& folder);

/// Everything in the folder that has the name of a file or folder of a run, but the mark. What comes first in the list
/// is to be deleted first: without its checkpoint a run cannot be resumed by halves.
/// @param of_writers names that the writers of the present case make; they count when the mark has them too
/// @throws FolderError when the folder cannot be read
std::vector<std::string> names_of_run(const std::filesystem::path& folder,
                                      const std::vector<std::string>& of_writers = {});

/// Everything else in the folder, by name, with what a run does not make in its folder of parts. Parameter and error as
/// of names_of_run().
std::vector<std::string> foreign_names(const std::filesystem::path& folder,
                                       const std::vector<std::string>& of_writers = {});

/// @param links_too are symbolic links an error?
/// @throws FolderError naming a file of a run that is a folder, a pipe, a device, or a link
void require_sound_entries(const std::filesystem::path& folder, const std::vector<std::string>& of_writers,
                           bool links_too);

/// Deletes the regular files and links that have names of a run, and the folder of parts when nothing else is in it.
/// @param of_writers as for names_of_run(); their folders are deleted whole
void delete_run(const std::filesystem::path& folder, const std::vector<std::string>& of_writers);

/// What a complete run has left that only a resumed one would need, by name: a kill may end it before it deletes this
/// itself. Damaged files are not among it, nor those of somebody else.
std::vector<std::string> leftovers(const std::filesystem::path& folder);
void delete_leftovers(const std::filesystem::path& folder);

/// Notes the names that the writers of a run make in its folder, before they make them.
/// @param fresh the run does not go on with an earlier one
/// @throws FolderError when a name is no plain name, or when a fresh run would write over a file of somebody else
void note_names(const std::filesystem::path& folder, const std::vector<std::string>& names, bool fresh);

} // namespace periporo
