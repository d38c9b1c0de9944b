// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Finds, checks and loads plugin libraries, and makes their objects by kind and name.
#pragma once

#include "periporo/contact.hpp"
#include "periporo/geometry.hpp"
#include "periporo/material.hpp"
#include "periporo/output.hpp"
#include "periporo/plugin.hpp"
#include "periporo/retention.hpp"

#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace periporo {

/// A plugin is missing, refused or failed in its constructor; the message says where was looked and what was wrong.
class PluginError : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// A loaded and accepted plugin.
struct PluginRecord {
    PluginKind kind;
    std::string name;
    std::string summary;
    std::filesystem::path file;
    std::vector<Parameter> parameters;
    const PluginDescriptor* descriptor = nullptr;
};

/// A library that looked like a plugin and was refused.
struct PluginFailure {
    std::filesystem::path file;
    std::string reason;
};

/// All plugins of a program run. Libraries stay loaded until the process ends.
class PluginRegistry {
public:
    /// Loads every plugin of the folders, in this order; a folder that does not exist is remembered for messages only.
    /// @throws PluginError when two libraries provide one kind and name, naming both files.
    void load_folders(const std::vector<std::filesystem::path>& folders);

    /// Takes a descriptor as if `file` had been loaded: the same checks, and a refusal is kept in failures(). Whoever
    /// calls vouches that the descriptor outlives every object made from it.
    /// @throws PluginError when another file provides the kind and name, naming both files.
    void add(const PluginDescriptor& descriptor, const std::filesystem::path& file);

    const std::vector<PluginRecord>& plugins() const { return plugins_; }
    const std::vector<PluginFailure>& failures() const { return failures_; }
    const std::vector<std::filesystem::path>& searched() const { return searched_; }

    /// Null when there is none.
    const PluginRecord* find(PluginKind kind, const std::string& name) const;
    /// @throws PluginError with the nearest name, all names of the kind, the folders searched and any library that was
    /// refused.
    const PluginRecord& require(PluginKind kind, const std::string& name) const;
    /// The text `require` would throw.
    std::string missing_message(PluginKind kind, const std::string& name) const;

    std::unique_ptr<Geometry> make_geometry(const std::string& name, const Parameters& parameters) const;
    std::unique_ptr<Material> make_material(const std::string& name, const Parameters& parameters) const;
    std::unique_ptr<Contact> make_contact(const std::string& name, const Parameters& parameters) const;
    std::unique_ptr<Retention> make_retention(const std::string& name, const Parameters& parameters) const;
    std::unique_ptr<OutputWriter> make_output(const std::string& name, const Parameters& parameters) const;

private:
    void load(const std::filesystem::path& file);
    void* make(PluginKind kind, const std::string& name, const Parameters& parameters) const;

    std::vector<PluginRecord> plugins_;
    std::vector<PluginFailure> failures_;
    std::vector<std::filesystem::path> searched_;
};

/// Folders in the order they are searched: `command_line`, `from_case`, PERIPORO_PLUGIN_PATH, then the folder of the
/// build or of the installation.
std::vector<std::filesystem::path> plugin_search_path(const std::vector<std::filesystem::path>& command_line,
                                                      const std::vector<std::filesystem::path>& from_case);

} // namespace periporo
