// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Hashes files, and finds the libraries that the process has loaded beyond those of the system.
#include "io/input_hashes.hpp"

#include <fmt/format.h>
#include <link.h>
#include <openssl/evp.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <string_view>
#include <system_error>
#include <vector>

namespace periporo {
namespace {

using std::filesystem::path;

bool is_of_system(const path& library)
{
    constexpr std::array<std::string_view, 4> folders{"/lib/", "/lib64/", "/usr/lib/", "/usr/lib64/"};
    return std::ranges::any_of(folders, [&](std::string_view folder) { return library.native().starts_with(folder); });
}

/// Shared libraries of the process outside of the folders of the system.
std::vector<path> loaded_libraries()
{
    std::vector<path> files;
    dl_iterate_phdr(
        [](dl_phdr_info* info, std::size_t, void* found) {
            std::error_code error;
            const path file = info->dlpi_name;
            const path whole = std::filesystem::weakly_canonical(file, error);
            if (!error && std::filesystem::is_regular_file(whole, error) && !is_of_system(whole))
                static_cast<std::vector<path>*>(found)->push_back(whole);
            return 0;
        },
        &files);
    return files;
}

/// Libraries that were loaded before main(): the program's own, and preloaded ones such as an allocator.
const std::vector<path> loaded_at_start = loaded_libraries();

constexpr const char* sdk_role = "library libperiporo_sdk.so"; // a part of the program

/// May a file of this role differ when a run is resumed?
bool may_differ(std::string_view role)
{
    return role == "case" || role.starts_with("include") || role == "program" || role == sdk_role;
}

} // namespace

std::string sha256_of(const path& file)
{
    std::ifstream stream(file, std::ios::binary);
    const std::unique_ptr<EVP_MD_CTX, void (*)(EVP_MD_CTX*)> context(EVP_MD_CTX_new(), EVP_MD_CTX_free);
    bool sound = stream && context && EVP_DigestInit_ex(context.get(), EVP_sha256(), nullptr) == 1;
    std::vector<char> buffer(1 << 20);
    while (sound && stream.read(buffer.data(), static_cast<std::streamsize>(buffer.size())).gcount() > 0)
        sound = EVP_DigestUpdate(context.get(), buffer.data(), static_cast<std::size_t>(stream.gcount())) == 1;
    std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
    unsigned size = 0;
    if (!sound || stream.bad() || EVP_DigestFinal_ex(context.get(), digest.data(), &size) != 1)
        throw std::runtime_error(
            fmt::format("{} cannot be read, and results must say what a run has read", file.string()));
    std::string text;
    for (unsigned n = 0; n < size; ++n)
        text += fmt::format("{:02x}", digest[n]);
    return text;
}

InputHashes InputHashes::of(const CaseDescription& description, const PluginRegistry& registry)
{
    InputHashes hashes;
    const auto add = [&](const std::string& role, const path& file) {
        hashes.entries_.insert_or_assign(role, Entry{sha256_of(file), file});
    };
    for (const InputFile& input : description.inputs)
        add(input.role, input.file);
    for (const path& library : loaded_libraries()) {
        const std::string role = "library " + library.filename().string();
        const bool of_start = role != sdk_role && std::ranges::count(loaded_at_start, library) > 0;
        if (!of_start &&
            std::ranges::find(registry.plugins(), library, &PluginRecord::file) == registry.plugins().end() &&
            std::ranges::find(registry.failures(), library, &PluginFailure::file) == registry.failures().end())
            add(role, library);
    }
    std::error_code error;
    if (const path program = std::filesystem::read_symlink("/proc/self/exe", error);
        std::filesystem::is_regular_file(program, error))
        add("program", program);
    return hashes;
}

std::string InputHashes::text() const
{
    std::string text;
    for (const auto& [role, entry] : entries_)
        text += fmt::format("{}\t{}\t{}\n", entry.hash, role, entry.file.string());
    return text;
}

InputHashes InputHashes::from_text(const std::string& text)
{
    InputHashes hashes;
    std::istringstream lines(text);
    for (std::string hash, role, file;
         std::getline(lines, hash, '\t') && std::getline(lines, role, '\t') && std::getline(lines, file);)
        hashes.entries_.insert_or_assign(role, Entry{hash, file});
    return hashes;
}

std::string InputHashes::difference_from(const InputHashes& before) const
{
    for (const auto& [role, entry] : entries_) {
        if (may_differ(role))
            continue;
        const auto old = before.entries_.find(role);
        if (old == before.entries_.end())
            return fmt::format("{} ({}) is read now and was not when the run was started", entry.file.string(), role);
        if (old->second.hash != entry.hash)
            return fmt::format("{} ({}) has changed since the run was started", entry.file.string(), role);
    }
    for (const auto& [role, entry] : before.entries_)
        if (!may_differ(role) && !entries_.contains(role))
            return fmt::format("{} ({}) was read when the run was started and is not now", entry.file.string(), role);
    return {};
}

} // namespace periporo
