// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The error of a folder that a run cannot use.
#pragma once

#include <exception>
#include <new>
#include <stdexcept>

namespace periporo {

/// A folder that a run cannot write to: the user chooses another one.
class FolderError : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// Runs `action`, which prepares a folder before the first step: any error but want of memory becomes FolderError.
template <class Action>
void as_fault_of_folder(Action&& action)
{
    try {
        action();
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& error) {
        throw FolderError(error.what());
    }
}

} // namespace periporo
