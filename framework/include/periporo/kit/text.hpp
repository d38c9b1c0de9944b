// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Sentences with numbers in them.
#pragma once

#include "periporo/tensor.hpp"

#include <iomanip>
#include <ostream>
#include <sstream>
#include <string>

namespace periporo::kit {

/// (xx yy zz xy yz xz)
inline std::string text(const SymmetricTensor<double>& a)
{
    std::ostringstream out;
    out << std::setprecision(9) << '(' << a.xx << ' ' << a.yy << ' ' << a.zz << ' ' << a.xy << ' ' << a.yz << ' '
        << a.xz << ')';
    return out.str();
}

/// Texts and numbers one after the other.
template <class... Parts>
std::string sentence(const Parts&... parts)
{
    std::ostringstream out;
    out << std::setprecision(9);
    (out << ... << parts);
    return out.str();
}

/// What a law said when it gave up.
inline std::string reason_text(const char* reason)
{
    return reason == nullptr ? "no reason given" : reason;
}

} // namespace periporo::kit
