// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The mark of a folder that holds a run: the process that wrote there last, and the names of its files.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <set>
#include <string>

namespace periporo {

/// The file that marks a folder of a run. Its first line names the process that wrote into the folder last; a line for
/// each file or folder follows that a writer of a run makes there. The system locks it, and the folder itself, while a
/// run goes on, and frees both at the end of the process by any cause.
inline constexpr const char* run_mark = "periporo.run";

/// Opens a file to be read. The stream stays closed for anything but a regular file: opening a pipe would wait.
std::ifstream open_if_regular(const std::filesystem::path& file);

/// The first line of a mark, always of the same length, so that a later process can write over it.
std::string first_line_of_mark(std::uint64_t process);
/// Has the file of this name begun as a mark, as far as it was written?
bool is_run_mark(const std::filesystem::path& file);
/// The process in the first line of a mark; "of unknown number" when there is none.
std::string process_of_mark(const std::filesystem::path& file);
/// May a writer give this name to a file of its own in the folder?
bool is_plain_name(const std::string& name);
/// The names that a mark lists. A last line that a kill has cut is left out.
std::set<std::string> names_in_mark(const std::filesystem::path& file);

} // namespace periporo
