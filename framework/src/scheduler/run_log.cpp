// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
#include "scheduler/run_log.hpp"

#include "periporo/file.hpp"

#include <spdlog/sinks/stdout_sinks.h>

#include <cerrno>

namespace periporo {
namespace {

constexpr std::size_t most_early_lines = 1000; ///< remarks on bodies and obstacles, warnings of the case

} // namespace

RunLog::RunLog(bool quiet) : early_(std::make_shared<spdlog::sinks::ringbuffer_sink_mt>(most_early_lines))
{
    const auto terminal = std::make_shared<spdlog::sinks::stderr_sink_mt>();
    terminal->set_pattern("%v");
    terminal->set_level(quiet ? spdlog::level::warn : spdlog::level::info);
    logger_ = std::make_shared<spdlog::logger>("run", spdlog::sinks_init_list{early_, terminal});
    logger_->flush_on(spdlog::level::info);
    // A log that cannot be written is no reason to end: what a run needs on the disk tells it by its own error.
    logger_->set_error_handler([](const std::string&) {});
}

void RunLog::open(const std::filesystem::path& file, bool append)
{
    require_regular(file);
    try {
        file_ = std::make_shared<spdlog::sinks::basic_file_sink_mt>(file.string(), !append);
    } catch (const spdlog::spdlog_ex&) { // its words have no way out
        throw FileError("cannot write", file, errno);
    }
    file_->set_pattern("%Y-%m-%d %H:%M:%S %l: %v");
    for (const spdlog::details::log_msg_buffer& line : early_->last_raw())
        file_->log(line);
    file_->flush();
    logger_->sinks().front() = file_;
}

void RunLog::add_to_file(const std::string& error)
{
    if (!file_)
        return;
    file_->log({"run", spdlog::level::err, error});
    file_->flush();
}

} // namespace periporo
