// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The side stack by the context functions of the C library.
#include "side_stack.hpp"

#include <sys/mman.h>

#include <cerrno>
#include <system_error>

namespace periporo::abaqus {

namespace {

// Fortran may keep large local arrays on its stack. Only pages that are touched cost memory.
constexpr std::size_t stack_size = std::size_t{64} << 20;
constexpr std::size_t guard_size = std::size_t{64} << 10; // at the low end, so that an overflow is a fault

thread_local SideStack* current = nullptr;

} // namespace

SideStack::SideStack()
    : memory_(::mmap(nullptr, stack_size, PROT_READ | PROT_WRITE,
                     MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE | MAP_STACK, -1, 0))
{
    if (memory_ == MAP_FAILED)
        throw std::system_error(errno, std::generic_category(), "a stack for the user routine");
    if (::mprotect(memory_, guard_size, PROT_NONE) != 0) {
        const int error = errno;
        ::munmap(memory_, stack_size);
        throw std::system_error(error, std::generic_category(), "the guard of a stack for the user routine");
    }
}

SideStack::~SideStack()
{
    ::munmap(memory_, stack_size);
}

void SideStack::enter()
{
    SideStack& self = *current;
    try {
        self.function_(self.argument_);
        self.ending_ = Ending::returned;
    } catch (...) {
        self.ending_ = Ending::threw;
    }
}

SideStack::Ending SideStack::run(void (*function)(void*), void* argument)
{
    function_ = function;
    argument_ = argument;
    ending_ = Ending::left;
    ::getcontext(&callee_);
    callee_.uc_stack.ss_sp = memory_;
    callee_.uc_stack.ss_size = stack_size;
    callee_.uc_link = &caller_;
    ::makecontext(&callee_, &SideStack::enter, 0);
    SideStack* const outer = current;
    current = this;
    ::swapcontext(&caller_, &callee_);
    current = outer;
    return ending_;
}

bool SideStack::in_use()
{
    return current != nullptr;
}

void SideStack::leave()
{
    if (current != nullptr)
        ::setcontext(&current->caller_);
}

} // namespace periporo::abaqus
