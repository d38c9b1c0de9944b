// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Exceptions to messages and exit statuses.
#include "cli/exit_status.hpp"

#include "case/reader.hpp"
#include "io/checkpoint.hpp"
#include "io/run_folder.hpp"
#include "plugins/registry.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <exception>
#include <new>
#include <string>

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
    } catch (const std::bad_alloc&) {
        return complain(ExitStatus::failed, "out of memory; a larger discretization.spacing or a smaller "
                                            "discretization.horizon needs less");
    } catch (const std::exception& error) {
        return complain(ExitStatus::failed, error.what());
    }
}

} // namespace periporo::cli
