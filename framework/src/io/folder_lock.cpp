// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Locks a folder and its mark by flock(2).
#include "io/folder_lock.hpp"

#include "io/folder_error.hpp"
#include "io/run_mark.hpp"
#include "periporo/file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <string>
#include <utility>
#include <vector>

namespace periporo {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void throw_in_use(const fs::path& folder)
{
    throw FolderError(fmt::format("another run writes into {}: process {}; wait for its end, or choose another --out",
                                  folder.string(), process_of_mark(folder / run_mark)));
}

/// Locks an open mark. Where the file system has no locks the run goes on without.
bool lock(int descriptor)
{
    while (::flock(descriptor, LOCK_EX | LOCK_NB) != 0) {
        if (errno == EWOULDBLOCK)
            return false;
        if (errno != EINTR)
            return true;
    }
    return true;
}

/// Is the open file the one that has this name?
bool is_file(int descriptor, const fs::path& name)
{
    struct stat open, named;
    return ::fstat(descriptor, &open) == 0 && ::lstat(name.c_str(), &named) == 0 && open.st_ino == named.st_ino &&
           open.st_dev == named.st_dev;
}

} // namespace

FolderLock::FolderLock(fs::path folder) : folder_(std::move(folder))
{
    std::error_code error;
    made_folder_ = fs::create_directories(folder_, error);
    if (error)
        throw FolderError(FileError("cannot make the folder", folder_, error.value()).what());
    try {
        lock_folder();
        lock_mark();
    } catch (...) {
        close();
        throw;
    }
}

void FolderLock::lock_folder()
{
    directory_ = ::open(folder_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (directory_ < 0)
        throw FolderError(FileError("cannot read", folder_, errno).what());
    if (!lock(directory_))
        throw_in_use(folder_);
}

void FolderLock::lock_mark()
{
    const fs::path mark = folder_ / run_mark;
    try {
        require_regular(mark);
    } catch (const std::exception& error) {
        throw FolderError(error.what());
    }
    do {
        if (mark_ >= 0)
            ::close(mark_);
        mark_ = ::open(mark.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK, 0666);
        if (mark_ < 0)
            throw FolderError(FileError("cannot write", mark, errno).what());
        if (!lock(mark_))
            throw_in_use(folder_);
    } while (!is_file(mark_, mark)); // a run that ended just now deleted the file that was opened
    const std::string line = first_line_of_mark(static_cast<std::uint64_t>(::getpid()));
    for (std::size_t done = 0; done < line.size();) { // the call after a short one has the reason
        const ssize_t count = ::pwrite(mark_, line.data() + done, line.size() - done, static_cast<off_t>(done));
        if (count < 0 && errno != EINTR)
            throw FolderError(FileError("cannot write", mark, errno).what());
        done += static_cast<std::size_t>(std::max<ssize_t>(count, 0));
    }
}

void FolderLock::close() noexcept
{
    for (int* descriptor : {&mark_, &directory_})
        if (const int number = std::exchange(*descriptor, -1); number >= 0)
            ::close(number); // frees the lock
}

FolderLock::~FolderLock()
{
    if (mark_ < 0)
        return;
    try {
        if (names_in(folder_) == std::vector<std::string>{run_mark}) { // nothing was written after all
            ::unlink((folder_ / run_mark).c_str());
            if (made_folder_)
                ::rmdir(folder_.c_str());
        }
    } catch (const std::exception&) { // a folder that cannot be read, or is gone, is left as it is
    }
    close();
}

FolderLock::FolderLock(FolderLock&& other) noexcept
    : folder_(std::move(other.folder_)), made_folder_(other.made_folder_),
      directory_(std::exchange(other.directory_, -1)), mark_(std::exchange(other.mark_, -1))
{
}

void require_no_run_in(const fs::path& folder)
{
    const int directory = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    const int mark = ::open((folder / run_mark).c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK);
    const bool free = (directory < 0 || lock(directory)) && (mark < 0 || lock(mark));
    for (const int descriptor : {directory, mark})
        if (descriptor >= 0)
            ::close(descriptor);
    if (!free)
        throw_in_use(folder);
}

} // namespace periporo
