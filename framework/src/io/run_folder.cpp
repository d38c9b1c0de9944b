// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Tells the files of a run from those of somebody else.
#include "io/run_folder.hpp"

#include "io/checkpoint.hpp"
#include "io/folder_error.hpp"
#include "io/run_mark.hpp"
#include "periporo/file.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <fstream>
#include <set>
#include <string_view>

namespace periporo {
namespace {

namespace fs = std::filesystem;

constexpr const char* parts_folder = "results.parts";

/// What every run makes in its folder, and what the writers of the program made before they told their names.
constexpr std::array known_names{checkpoint_name,
                                 previous_checkpoint_name,
                                 damaged_checkpoint_name,
                                 "checkpoint.h5",
                                 "summary.json",
                                 "results.h5",
                                 "results.xdmf",
                                 parts_folder,
                                 "history.csv",
                                 "history.csv.journal",
                                 "run.log",
                                 "case.toml"};

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

/// Names that every run makes, and those that a mark lists.
std::set<std::string> noted_names(const fs::path& folder)
{
    std::set<std::string> names = names_in_mark(folder / run_mark);
    names.insert(known_names.begin(), known_names.end());
    return names;
}

/// Names of what the program makes, and of what the writers of the present case make and noted before. A name that
/// stands in the mark alone is no proof that a run made the file: anybody can write a mark.
std::set<std::string> names_made(const fs::path& folder, const std::vector<std::string>& of_writers)
{
    std::set<std::string> names(known_names.begin(), known_names.end());
    const std::set<std::string> noted = noted_names(folder);
    for (const std::string& name : of_writers)
        if (noted.contains(name))
            names.insert(name);
    return names;
}

bool is_of_run(const std::string& name, const std::set<std::string>& made)
{
    return name == run_mark || made.contains(without_additions(name));
}

/// Names in a folder; none when it is not there.
std::vector<std::string> entries_of(const fs::path& folder)
{
    try {
        return names_in(folder);
    } catch (const FileError& error) {
        if (error.error() == ENOENT || error.error() == ENOTDIR) // a file is in its place, or above it
            return {};
        throw FolderError(error.what());
    }
}

bool is_number(std::string_view text)
{
    return !text.empty() && std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
}

bool is_damaged(const std::string& name)
{
    return name.find(".damaged") != std::string::npos;
}

/// Does a run give this name to a file in results.parts: "000012-2400.h5", "vertices-1200.h5", "journal"?
bool is_part_of_results(const std::string& name)
{
    std::string stem = without_additions(name);
    if (stem == "journal")
        return true;
    if (!stem.ends_with(".h5"))
        return false;
    stem.resize(stem.size() - 3);
    const std::size_t hyphen = stem.find('-');
    const std::string_view before = std::string_view(stem).substr(0, hyphen);
    return hyphen != std::string::npos && (before == "vertices" || (is_number(before) && before.size() >= 6)) &&
           is_number(std::string_view(stem).substr(hyphen + 1));
}

bool is_results_parts(const std::string& name)
{
    return without_additions(name) == parts_folder;
}

bool is_known(const std::string& name)
{
    return std::find(known_names.begin(), known_names.end(), without_additions(name)) != known_names.end();
}

/// Does the file begin as the log of a run does, "2026-01-31 12:00:00 info: "? Output that somebody redirected does
/// not.
bool is_run_log(const fs::path& file)
{
    std::ifstream stream = open_if_regular(file);
    std::string line;
    std::getline(stream, line);
    constexpr std::string_view form = "dddd-dd-dd dd:dd:dd ";
    return line.size() > form.size() && std::equal(form.begin(), form.end(), line.begin(), [](char wanted, char found) {
               return wanted == 'd' ? found >= '0' && found <= '9' : found == wanted;
           });
}

} // namespace

bool holds_run(const fs::path& folder)
{
    if (is_run_mark(folder / run_mark))
        return true;
    // A run of an earlier version has no mark, and somebody may delete one.
    std::error_code ignored;
    return is_run_log(folder / "run.log") && fs::is_regular_file(folder / "case.toml", ignored);
}

std::vector<std::string> names_of_run(const fs::path& folder, const std::vector<std::string>& of_writers)
{
    const std::set<std::string> made = names_made(folder, of_writers);
    std::vector<std::string> names = entries_of(folder);
    std::erase_if(names, [&](const std::string& name) { return name == run_mark || !is_of_run(name, made); });
    std::stable_partition(names.begin(), names.end(),
                          [](const std::string& name) { return name.starts_with("checkpoint"); });
    return names;
}

std::vector<std::string> foreign_names(const fs::path& folder, const std::vector<std::string>& of_writers)
{
    const std::set<std::string> made = names_made(folder, of_writers);
    std::vector<std::string> foreign;
    for (const std::string& name : entries_of(folder)) {
        if (!is_of_run(name, made))
            foreign.push_back(name);
        if (is_results_parts(name) && fs::is_directory(fs::symlink_status(folder / name)))
            for (const std::string& part : entries_of(folder / name))
                if (!is_part_of_results(part))
                    foreign.push_back(name + '/' + part);
    }
    return foreign;
}

void require_sound_entries(const fs::path& folder, const std::vector<std::string>& of_writers, bool links_too)
{
    const auto require = [&](const fs::path& file) {
        if (links_too && fs::is_symlink(fs::symlink_status(file)))
            throw FolderError(fmt::format("{} is a symbolic link, which a run does not follow; put the file itself in "
                                          "its place, or delete the link",
                                          file.string()));
        require_regular(file);
    };
    try {
        require(folder / run_mark);
        for (const std::string& name : names_of_run(folder, of_writers)) {
            const fs::path entry = folder / name;
            const bool is_folder = fs::is_directory(fs::symlink_status(entry));
            if (is_folder && is_results_parts(name)) {
                for (const std::string& part : entries_of(entry))
                    if (is_part_of_results(part))
                        require(entry / part);
            } else if (!is_folder || is_known(name)) { // a writer may make folders of its own
                require(entry);
            }
        }
    } catch (const FolderError&) {
        throw;
    } catch (const std::exception& error) {
        throw FolderError(error.what());
    }
}

void delete_run(const fs::path& folder, const std::vector<std::string>& of_writers)
{
    std::vector<fs::path> files, folders, of_others;
    for (const std::string& name : names_of_run(folder, of_writers)) {
        const fs::path entry = folder / name;
        if (!fs::is_directory(fs::symlink_status(entry))) {
            files.push_back(entry);
        } else if (is_results_parts(name)) {
            for (const std::string& part : entries_of(entry))
                if (is_part_of_results(part))
                    files.push_back(entry / part);
            folders.push_back(entry);
        } else {
            of_others.push_back(entry); // of a writer of this case, which named it by files()
        }
    }
    for (const fs::path& file : files)
        remove_file(file); // a link is deleted, and not what it points to
    for (const fs::path& emptied : folders)
        ::rmdir(emptied.c_str()); // files of somebody else keep it
    for (const fs::path& whole : of_others) {
        std::error_code error;
        fs::remove_all(whole, error);
        if (error)
            throw FileError("cannot delete", whole, error.value());
    }
}

std::vector<std::string> leftovers(const fs::path& folder)
{
    std::vector<std::string> left;
    for (const std::string& name : entries_of(folder)) {
        const bool is_folder = fs::is_directory(fs::symlink_status(folder / name));
        const std::string whole = is_damaged(name) ? "" : without_additions(name);
        if (!is_folder &&
            (whole == checkpoint_name || whole == previous_checkpoint_name || whole == "history.csv.journal"))
            left.push_back(name);
        if (!is_folder || name != parts_folder)
            continue;
        const std::vector<std::string> parts = entries_of(folder / name);
        for (const std::string& part : parts)
            if (is_part_of_results(part) && !is_damaged(part))
                left.push_back(name + '/' + part);
        if (parts.empty())
            left.push_back(name);
    }
    return left;
}

void delete_leftovers(const fs::path& folder)
{
    for (const std::string& name : leftovers(folder))
        if (name != parts_folder)
            remove_file(folder / name);
    ::rmdir((folder / parts_folder).c_str()); // files of somebody else keep it
}

void note_names(const fs::path& folder, const std::vector<std::string>& names, bool fresh)
{
    const std::set<std::string> noted = noted_names(folder);
    std::string lines;
    for (const std::string& name : names) {
        if (!is_plain_name(name))
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
        write_whole(mark, first_line_of_mark(static_cast<std::uint64_t>(::getpid())));
    if (lines.empty())
        return;
    AppendedFile file(mark);
    if (!read_whole(mark).ends_with('\n')) // what a kill left of a name
        file.append("\n");
    file.append(lines);
}

} // namespace periporo
