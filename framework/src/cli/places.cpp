// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Only the attempt tells: rights do not say that a file system takes no folders, as that of the processes does not.
#include "cli/places.hpp"

#include "cli/exit_status.hpp"
#include "periporo/file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <vector>

namespace periporo::cli {
namespace {

namespace fs = std::filesystem;

/// A folder and those above it that are not there, the lowest one first.
std::vector<fs::path> missing_folders(const fs::path& folder)
{
    std::vector<fs::path> missing;
    std::error_code ignored;
    for (fs::path at = fs::absolute(folder, ignored).lexically_normal();
         at.has_relative_path() && !fs::exists(at, ignored); at = at.parent_path())
        if (at.has_filename()) // and not the same with a slash at its end
            missing.push_back(at);
    return missing;
}

} // namespace

void require_possible_folder(const fs::path& folder)
{
    const std::vector<fs::path> missing = missing_folders(folder);
    std::vector<fs::path> made;
    int error = 0;
    for (auto at = missing.rbegin(); at != missing.rend() && error == 0; ++at) {
        error = ::mkdir(at->c_str(), 0777) == 0 ? 0 : errno;
        if (error == 0)
            made.push_back(*at);
    }
    const bool makeable = error == 0;
    if (makeable && ::access(folder.c_str(), W_OK | X_OK) != 0)
        error = errno;
    for (auto at = made.rbegin(); at != made.rend(); ++at)
        ::rmdir(at->c_str());
    if (error != 0)
        throw UsageError(FileError(makeable ? "cannot write" : "cannot make the folder", folder, error).what());
}

void require_possible_file(const fs::path& file)
{
    const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
    std::error_code ignored;
    if (!fs::is_directory(folder, ignored))
        throw UsageError(fmt::format("cannot write {}: there is no folder {}; make it or choose another name",
                                     file.string(), folder.string()));
    if (fs::is_directory(file, ignored))
        throw UsageError(fmt::format("cannot write {}: it is a folder; choose another name", file.string()));
    const fs::path part = part_of(file);
    const int descriptor = ::open(part.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor < 0 && errno != EEXIST)
        throw UsageError(fmt::format("cannot write {}: {}; choose another place", file.string(), std::strerror(errno)));
    if (descriptor >= 0) {
        ::close(descriptor);
        ::unlink(part.c_str());
    }
}

} // namespace periporo::cli
