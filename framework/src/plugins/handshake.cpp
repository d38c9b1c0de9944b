// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The checks of the handshake, in the order in which each makes the next one safe.
#include "plugins/handshake.hpp"

#include <fmt/format.h>

#include <string_view>

namespace periporo {

std::string descriptor_objection(const PluginDescriptor* descriptor)
{
    if (descriptor == nullptr)
        return fmt::format("{}() returned no descriptor", plugin_symbol);
    const PluginDescriptor& found = *descriptor;
    if (found.magic != plugin_magic)
        return fmt::format("not a periporo plugin: expected the magic number {:#010x}, found {:#010x}", plugin_magic,
                           found.magic);
    if (found.api_version != plugin_api_version)
        return fmt::format("built for another plugin API: expected version {}, found {}; rebuild it against this "
                           "program's headers",
                           plugin_api_version, found.api_version);
    if (found.size != sizeof(PluginDescriptor))
        return fmt::format("descriptor of another layout: expected {} bytes, found {}", sizeof(PluginDescriptor),
                           found.size);
    if (found.alignment != alignof(PluginDescriptor))
        return fmt::format("descriptor of another layout: expected an alignment of {} bytes, found {}",
                           alignof(PluginDescriptor), found.alignment);
    const std::string_view fingerprint = found.fingerprint != nullptr ? found.fingerprint : "none";
    if (fingerprint != abi_fingerprint.data())
        return fmt::format("built with other settings: expected \"{}\", found \"{}\"; rebuild it with the settings "
                           "that periporo_add_plugin() gives",
                           abi_fingerprint.data(), fingerprint);
    if (found.kind < PluginKind::geometry || found.kind > PluginKind::output)
        return fmt::format("unknown kind of plugin: expected {} to {}, found {}",
                           static_cast<std::uint32_t>(PluginKind::geometry),
                           static_cast<std::uint32_t>(PluginKind::output), static_cast<std::uint32_t>(found.kind));
    if (found.name == nullptr || *found.name == '\0')
        return "the descriptor names no plugin";
    if (found.summary == nullptr || found.parameters == nullptr || found.create == nullptr)
        return fmt::format("the descriptor of \"{}\" is incomplete: summary, parameters and create are needed",
                           found.name);
    return {};
}

} // namespace periporo
