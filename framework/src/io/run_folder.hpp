// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The files in a folder that belong to a run, and those of somebody else.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace periporo {

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
