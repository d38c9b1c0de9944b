// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Vectors of numbers that start on a cache line, as packs want them.
#pragma once

#include <cstddef>
#include <new>
#include <vector>

namespace periporo {

template <class Value>
struct CacheLineAllocator {
    using value_type = Value;
    static constexpr std::align_val_t alignment{64};

    CacheLineAllocator() = default;
    template <class Other>
    CacheLineAllocator(const CacheLineAllocator<Other>&)
    {
    }
    Value* allocate(std::size_t n) { return static_cast<Value*>(::operator new(n * sizeof(Value), alignment)); }
    void deallocate(Value* p, std::size_t) { ::operator delete(p, alignment); }
    friend bool operator==(const CacheLineAllocator&, const CacheLineAllocator&) { return true; }
};

/// The same for vectors whose numbers are all set before they are read: nothing is written to those that are added.
template <class Value>
struct UnsetAllocator : CacheLineAllocator<Value> {
    UnsetAllocator() = default;
    template <class Other>
    UnsetAllocator(const UnsetAllocator<Other>&)
    {
    }
    template <class Other>
    void construct(Other* p)
    {
        new (p) Other;
    }
};

template <class Value>
using AlignedVector = std::vector<Value, CacheLineAllocator<Value>>;
template <class Value>
using UnsetVector = std::vector<Value, UnsetAllocator<Value>>;

} // namespace periporo
