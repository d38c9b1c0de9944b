// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Exceptions to messages and exit statuses.
#include "cli/exit_status.hpp"

#include "case/reader.hpp"
#include "io/archive.hpp"
#include "io/checkpoint.hpp"
#include "io/folder_error.hpp"
#include "plugins/registry.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <exception>
#include <iostream>
#include <new>
#include <string>
#include <system_error>

namespace periporo::cli {
namespace {

/// Prints to standard error; a terminal that is gone is no error.
void tell(const std::string& text)
{
    std::fputs(text.c_str(), stderr);
}

ExitStatus complain(ExitStatus status, const char* message)
{
    tell(fmt::format("periporo: {}\n", message));
    return status;
}

} // namespace

ExitStatus report_unwritten_output(ExitStatus status)
{
    std::cout.flush();
    errno = 0;
    if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0 && std::cout.good())
        return status;
    tell(fmt::format("periporo: cannot write to the standard output{}; make room where it goes, or send it elsewhere\n",
                     errno != 0 ? fmt::format(": {}", std::strerror(errno)) : ""));
    return status == ExitStatus::done ? ExitStatus::failed : status;
}

ExitStatus report_faults(const std::function<ExitStatus()>& action)
{
    try {
        return action();
    } catch (const CaseError& error) {
        const std::size_t count = error.diagnostics().size();
        tell(fmt::format("{}{} error{}; nothing was run\n", error.what(), count, count == 1 ? "" : "s"));
        return ExitStatus::wrong_input;
    } catch (const PluginError& error) {
        return complain(ExitStatus::wrong_input, error.what());
    } catch (const UsageError& error) {
        return complain(ExitStatus::wrong_input, error.what());
    } catch (const FolderError& error) {
        return complain(ExitStatus::wrong_input, error.what());
    } catch (const ForeignCheckpoint& error) {
        return complain(ExitStatus::wrong_input, error.what());
    } catch (const ArchiveError& error) { // of a checkpoint that is read, before the first step
        return complain(ExitStatus::wrong_input, error.what());
    } catch (const std::bad_alloc&) {
        return complain(ExitStatus::failed, "out of memory; a larger discretization.spacing or a smaller "
                                            "discretization.horizon needs less");
    } catch (const std::exception& error) {
        if (dynamic_cast<const std::system_error*>(&error) != nullptr &&
            std::ferror(stdout) != 0) // report_unwritten_output() has words for it
            return ExitStatus::failed;
        return complain(ExitStatus::failed, error.what());
    }
}

} // namespace periporo::cli
