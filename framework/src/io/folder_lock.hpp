// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The lock of a folder while a run writes into it.
#pragma once

#include <filesystem>

namespace periporo {

/// Holds the lock of a folder, also when somebody deletes the mark. A folder in which nothing was written is left as it
/// was found.
class FolderLock {
public:
    /// Makes the folder and its mark where they are missing, and locks it.
    /// @throws FolderError with the number of the process when another run holds the lock, or with the system's reason
    /// when the folder cannot be written
    explicit FolderLock(std::filesystem::path folder);
    ~FolderLock();
    FolderLock(FolderLock&& other) noexcept;
    FolderLock& operator=(FolderLock&&) = delete;

private:
    void lock_folder();
    void lock_mark();
    void close() noexcept;

    std::filesystem::path folder_;
    bool made_folder_ = false;
    int directory_ = -1; ///< descriptor of the folder
    int mark_ = -1;      ///< descriptor of its mark
};

/// Throws as the constructor of FolderLock when a run goes on in the folder. Changes nothing.
void require_no_run_in(const std::filesystem::path& folder);

} // namespace periporo
