// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The log of a run, on the terminal and in its folder.
#pragma once

#include <filesystem>
#include <memory>
#include <spdlog/logger.h>
#include <spdlog/sinks/basic_file_sink.h>
#include <spdlog/sinks/ringbuffer_sink.h>

namespace periporo {

/// Holds back the lines of the file until the folder of the run may be made: a run that is refused leaves nothing.
class RunLog {
public:
    /// @param quiet shows warnings only on the terminal; the file gets every line
    explicit RunLog(bool quiet);

    const std::shared_ptr<spdlog::logger>& logger() const { return logger_; }
    /// Opens the file and writes into it what was said so far. @param append goes on with an earlier file
    void open(const std::filesystem::path& file, bool append);
    /// Writes an error into the file alone, if it is open; the terminal shows it by other ways.
    void add_to_file(const std::string& error);

private:
    std::shared_ptr<spdlog::sinks::ringbuffer_sink_mt> early_;
    std::shared_ptr<spdlog::sinks::basic_file_sink_mt> file_;
    std::shared_ptr<spdlog::logger> logger_;
};

} // namespace periporo
