// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
#include "io/run_folder.hpp"

#include "io/checkpoint.hpp"
#include "periporo/file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <set>
#include <sstream>
#include <string_view>
#include <utility>

namespace periporo {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view mark_begin = "A run of periporo writes into this folder; the last one was process ";

/// What every run makes in its folder, and what the writers of the program made before they told their names.
constexpr std::array known_names{
    checkpoint_name, previous_checkpoint_name, damaged_checkpoint_name, "checkpoint.h5", "summary.json", "results.h5",
    "results.xdmf",  "results.parts",          "history.csv",           "run.log",       "case.toml"};

std::string first_line(std::uint64_t process)
{
    return fmt::format("{}{:20}\n", mark_begin, process); // of fixed length: it is written again in its place
}

bool is_plain(const std::string& name)
{
    return !name.empty() && name.find('/') == std::string::npos && name != "." && name != ".." && name != run_mark &&
           name.find_first_of("\n\r") == std::string::npos;
}

/// A name without what was added to it while a file was written or when it was found damaged.
std::string without_additions(std::string name)
{
    if (name == "history.csv.new") // how an earlier version wrote it aside
        return "history.csv";
    if (name.ends_with(".part"))
        name.resize(name.size() - 5);
    const std::size_t damaged = name.rfind(".damaged");
    if (damaged != std::string::npos) {
        const std::string_view rest = std::string_view(name).substr(damaged + 8);
        const bool numbered = rest.size() > 1 && rest.front() == '.' &&
                              std::all_of(rest.begin() + 1, rest.end(), [](char c) { return c >= '0' && c <= '9'; });
        if (rest.empty() || numbered)
            name.resize(damaged);
    }
    return name;
}

std::set<std::string> noted_names(const fs::path& folder)
{
    std::set<std::string> names(known_names.begin(), known_names.end());
    std::ifstream mark(folder / run_mark);
    std::string line;
    std::getline(mark, line);
    while (std::getline(mark, line))
        if (is_plain(line) && !mark.eof()) // a kill may have cut the last line
            names.insert(line);
    return names;
}

bool is_of_run(const std::string& name, const std::set<std::string>& noted)
{
    return name == run_mark || noted.contains(without_additions(name));
}

std::vector<std::string> names_in(const fs::path& folder)
{
    std::vector<std::string> names;
    std::error_code ignored;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, ignored))
        names.push_back(entry.path().filename().string());
    std::sort(names.begin(), names.end());
    return names;
}

/// Does the file begin as the log of a run does, "2026-01-31 12:00:00 info: "? Output that somebody redirected does
/// not.
bool is_run_log(const fs::path& file)
{
    std::ifstream stream(file);
    std::string line;
    std::getline(stream, line);
    constexpr std::string_view form = "dddd-dd-dd dd:dd:dd ";
    return line.size() > form.size() && std::equal(form.begin(), form.end(), line.begin(), [](char wanted, char found) {
               return wanted == 'd' ? found >= '0' && found <= '9' : found == wanted;
           });
}

[[noreturn]] void throw_in_use(const fs::path& folder)
{
    std::ifstream mark(folder / run_mark);
    std::string line;
    std::getline(mark, line);
    std::string process = line.size() > mark_begin.size() ? line.substr(mark_begin.size()) : "of unknown number";
    process.erase(0, process.find_first_not_of(' '));
    throw FolderError(fmt::format("another run writes into {}: process {}; wait for its end, or choose another --out",
                                  folder.string(), process));
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
    const fs::path mark = folder_ / run_mark;
    do {
        if (descriptor_ >= 0)
            ::close(descriptor_);
        descriptor_ = ::open(mark.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0666);
        if (descriptor_ < 0)
            throw FolderError(FileError("cannot write", mark, errno).what());
        if (!lock(descriptor_)) {
            ::close(descriptor_);
            throw_in_use(folder_);
        }
    } while (!is_file(descriptor_, mark)); // a run that ended just now deleted the file that was opened
    const std::string line = first_line(static_cast<std::uint64_t>(::getpid()));
    if (::pwrite(descriptor_, line.data(), line.size(), 0) != static_cast<ssize_t>(line.size())) {
        const int reason = errno;
        ::close(descriptor_);
        throw FolderError(FileError("cannot write", mark, reason).what());
    }
}

FolderLock::~FolderLock()
{
    if (descriptor_ < 0)
        return;
    if (names_in(folder_) == std::vector<std::string>{run_mark}) { // nothing was written after all
        ::unlink((folder_ / run_mark).c_str());
        if (made_folder_)
            ::rmdir(folder_.c_str());
    }
    ::close(descriptor_); // frees the lock
}

FolderLock::FolderLock(FolderLock&& other) noexcept
    : folder_(std::move(other.folder_)), made_folder_(other.made_folder_),
      descriptor_(std::exchange(other.descriptor_, -1))
{
}

void require_no_run_in(const fs::path& folder)
{
    const int descriptor = ::open((folder / run_mark).c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW);
    if (descriptor < 0)
        return;
    const bool free = lock(descriptor);
    ::close(descriptor);
    if (!free)
        throw_in_use(folder);
}

bool holds_run(const fs::path& folder)
{
    std::ifstream mark(folder / run_mark);
    std::string line;
    std::getline(mark, line);
    if (line.starts_with(mark_begin) || (fs::exists(folder / run_mark) && line.empty()))
        return true;
    return is_run_log(folder / "run.log") && fs::is_regular_file(folder / "case.toml"); // of an earlier version
}

std::vector<std::string> names_of_run(const fs::path& folder)
{
    const std::set<std::string> noted = noted_names(folder);
    std::vector<std::string> names = names_in(folder);
    std::erase_if(names, [&](const std::string& name) { return name == run_mark || !is_of_run(name, noted); });
    std::stable_partition(names.begin(), names.end(),
                          [](const std::string& name) { return name.starts_with("checkpoint"); });
    return names;
}

std::vector<std::string> foreign_names(const fs::path& folder)
{
    const std::set<std::string> noted = noted_names(folder);
    std::vector<std::string> names = names_in(folder);
    std::erase_if(names, [&](const std::string& name) { return is_of_run(name, noted); });
    return names;
}

void note_names(const fs::path& folder, const std::vector<std::string>& names, bool fresh)
{
    const std::set<std::string> noted = noted_names(folder);
    std::string lines;
    for (const std::string& name : names) {
        if (!is_plain(name))
            throw FolderError(fmt::format("a writer names \"{}\" as a file of its own, which is no plain name", name));
        if (noted.contains(name))
            continue;
        if (fresh && fs::exists(fs::symlink_status(folder / name)))
            throw FolderError(fmt::format("{} was not written by a run, and a writer of this run would replace it; "
                                          "move it away or choose another --out",
                                          (folder / name).string()));
        lines += name + '\n';
    }
    const fs::path mark = folder / run_mark;
    if (!fs::exists(mark))
        write_whole(mark, first_line(static_cast<std::uint64_t>(::getpid())));
    if (lines.empty())
        return;
    AppendedFile file(mark);
    if (!read_whole(mark).ends_with('\n')) // what a kill left of a name
        file.append("\n");
    file.append(lines);
}

} // namespace periporo
