// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Loading by Boost.DLL, and messages that say what to do.
#include "routine_library.hpp"

#include "periporo/library_file.hpp"
#include "utility_routines.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <list>
#include <stdexcept>
#include <vector>

namespace periporo::abaqus {

namespace {

/// What the linker said, with a hint.
std::string load_objection(const std::string& library, const std::string& error)
{
    static const std::string mark = "undefined symbol: ";
    const std::size_t at = error.find(mark);
    if (at == std::string::npos)
        return fmt::format("library \"{}\" cannot be loaded: {}; it must be a shared library for this machine, as "
                           "gfortran -shared -fPIC makes it from a source",
                           library, error);
    std::string symbol = error.substr(at + mark.size());
    symbol = symbol.substr(0, symbol.find_first_of(" ,\"])\n"));
    return fmt::format("library \"{}\" cannot be loaded: it needs the symbol {}, which nothing provides. If it is a "
                       "routine of yours, compile its source into the library; if it belongs to a run-time library "
                       "such as gfortran's, link that one. Of the routines of Abaqus only these exist here: {}",
                       library, symbol, utility_routine_names);
}

void check_path(const std::string& library)
{
    const std::filesystem::path path(library);
    if (path.has_parent_path() && path.is_relative())
        throw std::runtime_error(fmt::format("library \"{}\" is a relative path, and a material does not know the "
                                             "folder of its case: give an absolute path, or a bare file name, which "
                                             "is searched in LD_LIBRARY_PATH and the folders of the system",
                                             library));
    if (path.has_parent_path() && !std::filesystem::exists(path))
        throw std::runtime_error(fmt::format("library \"{}\": there is no such file", library));
    if (const std::string objection = library_objection(path); path.has_parent_path() && !objection.empty())
        throw std::runtime_error(
            fmt::format("library \"{}\": {}; it must be a shared library for this machine, as gfortran -shared -fPIC "
                        "makes it from a source",
                        library, objection));
}

std::string upper_case(std::string text)
{
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char letter) { return static_cast<char>(std::toupper(letter)); });
    return text;
}

} // namespace

RoutineLibrary& RoutineLibrary::load(const std::string& library)
{
    // Never destroyed on purpose: materials may live until the very end of the process.
    static auto* const loaded = new std::list<RoutineLibrary>;
    static std::mutex loading;
    const std::lock_guard alone(loading);
    check_path(library);
    share_utility_routines();
    watch_end_of_process();
    boost::dll::shared_library file;
    try {
        using boost::dll::load_mode::type;
        type mode = type::rtld_now | type::rtld_local;
        if (!std::filesystem::path(library).has_parent_path())
            mode |= type::search_system_folders;
        file.load(library, mode);
    } catch (const std::exception& error) {
        throw std::runtime_error(load_objection(library, error.what()));
    }
    // one file has one lock, however it was named
    for (RoutineLibrary& other : *loaded)
        if (other.library_.native() == file.native())
            return other;
    return loaded->emplace_back(std::move(file));
}

const char* RoutineLibrary::keep(std::string text)
{
    const std::lock_guard alone(texts_mutex_);
    return texts_.insert(std::move(text)).first->c_str();
}

void RoutineLibrary::require(const std::string& symbol, const std::string& interface) const
{
    if (library_.has(symbol))
        return;
    std::vector<std::string> there;
    for (const std::string name : {"umat", "vumat"})
        for (const std::string& candidate : {name + "_", name, name + "__", upper_case(name), upper_case(name) + "_"})
            if (library_.has(candidate))
                there.push_back(candidate);
    throw std::runtime_error(fmt::format(
        "library \"{}\" exports no symbol {}; {}", library_.location().string(), symbol,
        there.empty()
            ? fmt::format("a Fortran compiler makes {}_ of SUBROUTINE {}; nm -D --defined-only lists what the "
                          "library exports, and the parameter symbol names another one",
                          interface, upper_case(interface))
            : fmt::format("it exports {}: set the parameter symbol or interface", fmt::join(there, ", "))));
}

} // namespace periporo::abaqus
