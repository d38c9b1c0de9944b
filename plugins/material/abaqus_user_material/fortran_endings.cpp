// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// STOP, ERROR STOP, CALL EXIT, CALL ABORT and failed run-time checks of gfortran, under the names of its run-time
// library, and exit() of C: a routine that ends the process would take the run with it.
//
// Source of the interfaces: libgfortran of GCC 12, runtime/stop.c, runtime/error.c, intrinsics/exit.c.
#include "side_stack.hpp"
#include "utility_routines.hpp"

#include <fmt/format.h>

#include <array>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>
#include <unistd.h>

namespace periporo::abaqus {
namespace {

std::string after_colon(std::string_view text)
{
    return text.empty() ? std::string() : fmt::format(": {}", text);
}

/// The program begins to end by exit(). Its files cannot be relied on any more, so nothing but the message is left.
void end_of_process(int status, void*)
{
    if (!SideStack::in_use())
        return;
    std::fprintf(stderr,
                 "a user routine ended the program by exit(%d); it must return, or call XIT. The run goes on from its "
                 "last checkpoint with --resume\n",
                 status);
    std::fflush(stderr);
    ::_exit(EXIT_FAILURE);
}

} // namespace

void watch_end_of_process()
{
    static const int watching = ::on_exit(end_of_process, nullptr);
    static_cast<void>(watching);
}

} // namespace periporo::abaqus

using namespace periporo::abaqus;

#pragma GCC visibility push(default)
extern "C" {

[[noreturn]] void _gfortran_stop_string(const char* text, std::size_t length, bool)
{
    leave_with_error("STOP" + after_colon({text, length}));
}

[[noreturn]] void _gfortran_stop_numeric(int code, bool)
{
    leave_with_error(fmt::format("STOP {}", code));
}

[[noreturn]] void _gfortran_error_stop_string(const char* text, std::size_t length, bool)
{
    leave_with_error("ERROR STOP" + after_colon({text, length}));
}

[[noreturn]] void _gfortran_error_stop_numeric(int code, bool)
{
    leave_with_error(fmt::format("ERROR STOP {}", code));
}

[[noreturn]] void _gfortran_exit_i4(const int* status)
{
    leave_with_error(fmt::format("CALL EXIT({})", status != nullptr ? *status : 0));
}

[[noreturn]] void _gfortran_abort()
{
    leave_with_error("CALL ABORT");
}

/// What -fcheck calls, as for an index out of bounds.
[[noreturn]] void _gfortran_runtime_error_at(const char* where, const char* format, ...)
{
    std::array<char, 500> text{};
    va_list values;
    va_start(values, format);
    std::vsnprintf(text.data(), text.size(), format, values);
    va_end(values);
    leave_with_error(fmt::format("{}: {}", where, text.data()));
}
}
#pragma GCC visibility pop
