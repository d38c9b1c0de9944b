// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The table of accepted and refused plugins, and the making of their objects.
#include "plugins/registry.hpp"

#include "periporo/library_file.hpp"
#include "plugins/handshake.hpp"
#include "plugins/loader.hpp"
#include "sdk/nearest_name.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <system_error>

namespace periporo {

namespace {

using std::filesystem::path;

/// One file has one name here, however it was reached.
path identity(const path& file)
{
    std::error_code error;
    path result = std::filesystem::weakly_canonical(file, error);
    return error ? file : result;
}

/// The shared libraries of a folder in the order of their names, so that messages do not depend on the file system.
std::vector<path> libraries_of(const path& folder, std::error_code& error)
{
    std::vector<path> files;
    for (std::filesystem::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error))
        if (entry->path().extension() == ".so" && !entry->is_directory(error))
            files.push_back(entry->path());
    std::sort(files.begin(), files.end());
    return files;
}

} // namespace

void PluginRegistry::load_folders(const std::vector<path>& folders)
{
    for (const path& folder : folders) {
        if (std::find(searched_.begin(), searched_.end(), folder) == searched_.end())
            searched_.push_back(folder);
        std::error_code error;
        for (const path& file : libraries_of(folder, error))
            load(file);
        if (error && error != std::errc::no_such_file_or_directory)
            failures_.push_back({folder, fmt::format("the folder cannot be read: {}", error.message())});
    }
}

void PluginRegistry::load(const path& file)
{
    const path known = identity(file);
    const auto is_known = [&](const auto& entry) { return entry.file == known; };
    if (std::any_of(plugins_.begin(), plugins_.end(), is_known) ||
        std::any_of(failures_.begin(), failures_.end(), is_known))
        return;
    if (const std::string objection = library_objection(known); !objection.empty()) {
        failures_.push_back({known, fmt::format("cannot be loaded: {}: {}", known.filename().string(), objection)});
        return;
    }
    const PluginDescriptor* descriptor = nullptr;
    try {
        descriptor = load_descriptor(known);
    } catch (const std::exception& error) {
        failures_.push_back({known, error.what()});
        return;
    }
    if (descriptor == nullptr)
        failures_.push_back({known, descriptor_objection(nullptr)});
    else
        add(*descriptor, known);
}

void PluginRegistry::add(const PluginDescriptor& descriptor, const path& file)
{
    const path known = identity(file);
    if (std::string objection = descriptor_objection(&descriptor); !objection.empty()) {
        failures_.push_back({known, std::move(objection)});
        return;
    }
    if (const PluginRecord* other = find(descriptor.kind, descriptor.name)) {
        if (other->file == known)
            return;
        throw PluginError(fmt::format("two {} plugins are named \"{}\":\n  {}\n  {}\nremove one of them or its folder "
                                      "from the search path",
                                      kind_name(descriptor.kind), descriptor.name, other->file.string(),
                                      known.string()));
    }
    PluginRecord record{descriptor.kind, descriptor.name, descriptor.summary, known, {}, &descriptor};
    try {
        descriptor.parameters(record.parameters);
    } catch (const std::exception& error) {
        failures_.push_back({known, fmt::format("its list of parameters failed: {}", error.what())});
        return;
    }
    plugins_.push_back(std::move(record));
}

const PluginRecord* PluginRegistry::find(PluginKind kind, const std::string& name) const
{
    const auto found = std::find_if(plugins_.begin(), plugins_.end(), [&](const PluginRecord& record) {
        return record.kind == kind && record.name == name;
    });
    return found == plugins_.end() ? nullptr : &*found;
}

const PluginRecord& PluginRegistry::require(PluginKind kind, const std::string& name) const
{
    if (const PluginRecord* record = find(kind, name))
        return *record;
    throw PluginError(missing_message(kind, name));
}

std::string PluginRegistry::missing_message(PluginKind kind, const std::string& name) const
{
    std::vector<std::string> names;
    for (const PluginRecord& record : plugins_)
        if (record.kind == kind)
            names.push_back(record.name);
    std::sort(names.begin(), names.end());

    std::string text = fmt::format("there is no {} plugin \"{}\"", kind_name(kind), name);
    const auto append = std::back_inserter(text);
    if (const auto near = nearest_name(name, names))
        fmt::format_to(append, "; did you mean {}?", *near);
    if (names.empty())
        fmt::format_to(append, "\n  no {} plugin is loaded", kind_name(kind));
    else
        fmt::format_to(append, "\n  {} plugins: {}", kind_name(kind), fmt::join(names, ", "));
    fmt::format_to(append, "\n  folders searched:{}", searched_.empty() ? " none" : "");
    for (const path& folder : searched_) {
        std::error_code error;
        fmt::format_to(append, "\n    {}{}", folder.string(),
                       std::filesystem::is_directory(folder, error) ? "" : " (no such folder)");
    }
    if (!failures_.empty())
        fmt::format_to(append, "\n  libraries refused:");
    for (const PluginFailure& failure : failures_)
        fmt::format_to(append, "\n    {}: {}", failure.file.string(), failure.reason);
    return text;
}

void* PluginRegistry::make(PluginKind kind, const std::string& name, const Parameters& parameters) const
{
    const PluginRecord& record = require(kind, name);
    std::string error;
    void* object = record.descriptor->create(parameters, error);
    if (object == nullptr)
        throw PluginError(fmt::format("{} plugin \"{}\" ({}): {}", kind_name(kind), name, record.file.string(),
                                      error.empty() ? "it made no object and gave no reason" : error));
    return object;
}

std::unique_ptr<Geometry> PluginRegistry::make_geometry(const std::string& name, const Parameters& parameters) const
{
    return std::unique_ptr<Geometry>(static_cast<Geometry*>(make(PluginKind::geometry, name, parameters)));
}

std::unique_ptr<Material> PluginRegistry::make_material(const std::string& name, const Parameters& parameters) const
{
    return std::unique_ptr<Material>(static_cast<Material*>(make(PluginKind::material, name, parameters)));
}

std::unique_ptr<Contact> PluginRegistry::make_contact(const std::string& name, const Parameters& parameters) const
{
    return std::unique_ptr<Contact>(static_cast<Contact*>(make(PluginKind::contact, name, parameters)));
}

std::unique_ptr<Retention> PluginRegistry::make_retention(const std::string& name, const Parameters& parameters) const
{
    return std::unique_ptr<Retention>(static_cast<Retention*>(make(PluginKind::retention, name, parameters)));
}

std::unique_ptr<OutputWriter> PluginRegistry::make_output(const std::string& name, const Parameters& parameters) const
{
    return std::unique_ptr<OutputWriter>(static_cast<OutputWriter*>(make(PluginKind::output, name, parameters)));
}

} // namespace periporo
