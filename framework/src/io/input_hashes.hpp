// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The content of every file that a run reads, as SHA-256.
#pragma once

#include "case/description.hpp"
#include "plugins/registry.hpp"

#include <filesystem>
#include <map>
#include <string>

namespace periporo {

/// SHA-256 of a file as 64 hexadecimal digits, by libcrypto: it is maintained, uses the instructions of the processor,
/// and HDF5 links to it already.
/// @throws std::runtime_error naming the file when it cannot be read.
std::string sha256_of(const std::filesystem::path& file);

/// Hashes by the role of a file; see InputFile.
class InputHashes {
public:
    /// Hashes the case and its includes, the files and plugins that it names, the libraries that plugins have loaded,
    /// and the program itself. Libraries of the system are left out.
    /// @param registry whose plugins have made their objects before, so that what they load is loaded
    static InputHashes of(const CaseDescription& description, const PluginRegistry& registry);

    /// One line for each file: hash, role, path, with tabs between them.
    std::string text() const;
    /// @param text of text()
    static InputHashes from_text(const std::string& text);

    /// Says which file had another content when `before` was found, or is an empty text. Files of the case itself may
    /// differ, since the resolved case is compared as a whole; so may the program, whose checkpoints have a version.
    std::string difference_from(const InputHashes& before) const;

    struct Entry {
        std::string hash;
        std::filesystem::path file;
    };
    const std::map<std::string, Entry>& entries() const { return entries_; }

private:
    std::map<std::string, Entry> entries_;
};

} // namespace periporo
