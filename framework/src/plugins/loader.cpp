// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Loading by Boost.DLL, and the store that keeps every library for the life of the process.
#include "plugins/loader.hpp"

#define BOOST_DLL_USE_STD_FS
#include <boost/dll/shared_library.hpp>

#include <fmt/format.h>

#include <stdexcept>
#include <utility>
#include <vector>

namespace periporo {

namespace {

/// Never destroyed on purpose: virtual tables, destructors and texts of plugins live in these libraries and may be
/// needed until the very last object of the process is gone.
std::vector<boost::dll::shared_library>& loaded_libraries()
{
    static auto* const libraries = new std::vector<boost::dll::shared_library>;
    return *libraries;
}

/// The text of the dynamic loader, out of the message of Boost.DLL around it.
std::string reason_of(const std::string& message)
{
    constexpr std::string_view before = "dlerror system message: ";
    const std::size_t begin = message.find(before);
    const std::size_t end = message.rfind("): ");
    if (begin == std::string::npos || end == std::string::npos || end < begin + before.size())
        return message;
    return message.substr(begin + before.size(), end - begin - before.size());
}

} // namespace

const PluginDescriptor* load_descriptor(const std::filesystem::path& file)
{
    boost::dll::shared_library library;
    try {
        library.load(file, boost::dll::load_mode::rtld_now | boost::dll::load_mode::rtld_local);
    } catch (const std::exception& error) {
        throw std::runtime_error(fmt::format("cannot be loaded: {}", reason_of(error.what())));
    }
    const boost::dll::shared_library& kept = loaded_libraries().emplace_back(std::move(library));
    if (!kept.has(plugin_symbol))
        throw std::runtime_error(
            fmt::format("exports no symbol {}; a plugin source ends with PERIPORO_PLUGIN(...)", plugin_symbol));
    return kept.get<const PluginDescriptor*()>(plugin_symbol)();
}

} // namespace periporo
