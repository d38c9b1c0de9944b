// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// What a writer finds of an earlier run, before a resumed run writes anything: an addition to OutputWriter that a
// writer may have.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace periporo {

/// A snapshot that a writer has been given.
struct SnapshotMoment {
    std::uint64_t step = 0;
    double time = 0.0; ///< [s]
};

/// What a folder holds of an earlier run.
struct EarlierOutput {
    /// Rows and snapshots in words, "3 snapshots in results.parts"; none when nothing of a run would be lost.
    std::vector<std::string> holds;
    bool complete = false; ///< the files say that the run is complete
    /// Steps of the snapshots that are there, or were set aside; nothing when the writer stores no snapshots.
    std::optional<std::vector<std::uint64_t>> snapshots;
    /// A file that every checkpoint counts on, and that is not there; or an empty text.
    std::string missing_record;
    /// A file that every complete run leaves, and that is not there or not whole; or an empty text.
    std::string missing_result;
};

/// A writer derives from this class beside OutputWriter. Without it, each of its files() counts as results.
class EarlierOutputReader {
public:
    virtual ~EarlierOutputReader() = default;

    /// Looks at the folder and changes nothing. @throws std::exception when something there cannot be read
    virtual EarlierOutput earlier_output(const std::filesystem::path& directory) const = 0;

    /// Called before begin() of a resumed run.
    /// @param snapshots all that the writer had been given when the checkpoint was written: the first has number 0
    virtual void expect(std::vector<SnapshotMoment> snapshots) = 0;
};

} // namespace periporo
