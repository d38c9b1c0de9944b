// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The user's shared library: loaded once, kept for the life of the process, one lock for all calls into it.
#pragma once

#define BOOST_DLL_USE_STD_FS
#include <boost/dll/shared_library.hpp>

#include <mutex>
#include <set>
#include <string>
#include <utility>

namespace periporo::abaqus {

class RoutineLibrary {
public:
    /// @param library an absolute path, or a bare file name that is searched as the dynamic linker does
    /// @throws std::runtime_error that says what to do
    static RoutineLibrary& load(const std::string& library);

    explicit RoutineLibrary(boost::dll::shared_library library) : library_(std::move(library)) {}

    /// The routine of a symbol.
    /// @param interface "umat" or "vumat", for the hint
    /// @throws std::runtime_error that names the symbol and what the library has instead
    template <class Function>
    Function* routine(const std::string& symbol, const std::string& interface) const
    {
        require(symbol, interface);
        return &library_.get<Function>(symbol);
    }

    /// Held during calls of routines that are not safe for several threads.
    std::mutex& mutex() { return mutex_; }

    /// The text as one that lives to the end of the process, like the library.
    const char* keep(std::string text);

private:
    void require(const std::string& symbol, const std::string& interface) const;

    boost::dll::shared_library library_;
    std::mutex mutex_;
    std::mutex texts_mutex_;
    std::set<std::string> texts_;
};

} // namespace periporo::abaqus
