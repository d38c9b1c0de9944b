// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
#include "scheduler/provenance.hpp"

#include <boost/crc.hpp>
#include <fmt/format.h>
#include <fstream>
#include <iterator>
#include <omp.h>

namespace periporo {
namespace {

std::string checksum(const std::filesystem::path& file)
{
    std::ifstream stream(file, std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(stream), {}};
    boost::crc_32_type crc;
    crc.process_bytes(bytes.data(), bytes.size());
    return fmt::format("{:08x}", crc.checksum());
}

} // namespace

std::map<std::string, std::string> provenance(const CaseDescription& description, const PluginRegistry& registry,
                                              int threads)
{
    std::map<std::string, std::string> entries{
        {"periporo_version", PERIPORO_VERSION},
        {"compiler", "gcc " __VERSION__},
        {"abi", abi_fingerprint.data()},
        {"threads", std::to_string(threads > 0 ? threads : omp_get_max_threads())}};
    const auto add = [&](PluginKind kind, const std::string& name) {
        if (const PluginRecord* plugin = registry.find(kind, name))
            entries[fmt::format("plugin_{}_{}", kind_name(kind), name)] =
                fmt::format("{} crc32 {}", plugin->file.string(), checksum(plugin->file));
    };
    for (const MaterialDescription& material : description.materials)
        add(PluginKind::material, material.model.name);
    for (const BodyDescription& body : description.bodies)
        add(PluginKind::geometry, body.geometry.name);
    for (const ContactDescription& contact : description.contacts)
        add(PluginKind::contact, contact.law.name);
    for (const OutputDescription& output : description.outputs)
        add(PluginKind::output, output.writer.name);
    return entries;
}

} // namespace periporo
