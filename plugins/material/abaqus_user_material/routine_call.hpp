// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// What UMAT and VUMAT have in common: settings, the arrays that one thread calls with, and how a call went.
#pragma once

#include "periporo/material.hpp"
#include "periporo/pack.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace periporo::abaqus {

/// What every call hands over besides stress, state and strain increment.
struct RoutineSettings {
    std::vector<double> properties;     ///< PROPS
    std::size_t state_count = 0;        ///< NSTATV
    std::array<char, 80> name{};        ///< CMNAME, padded with blanks
    double stress_unit = 1.0;           ///< [Pa], one unit of stress of the routine
    double temperature = 0.0;           ///< TEMP
    double characteristic_length = 0.0; ///< CELENT [m]
    /// Stands for what is not known here: total strain, place, time before the increment, and the components off the
    /// diagonal of the deformation gradient. `unknown_one` stands for those on it. Both are not-a-number or 0 and 1.
    double unknown = 0.0;
    double unknown_one = 1.0;
};

enum class RoutineFailure { none, reported, smaller_step, not_finite, wrote_past_state };

/// One bond of a batch.
class Bond {
public:
    Bond(const MaterialBatch& batch, std::size_t state_count, std::size_t index)
        : rows_(batch.bonds + index / pack_width * (6 + state_count) * pack_width + index % pack_width),
          strain_(batch.strain_increment + index / pack_width * 6 * pack_width + index % pack_width),
          suction_(batch.suction[index]), saturation_(batch.saturation[index])
    {
    }

    double& stress(std::size_t component) const { return rows_[component * pack_width]; }
    double& state(std::size_t variable) const { return rows_[(6 + variable) * pack_width]; }
    double strain_increment(std::size_t component) const { return strain_[component * pack_width]; }
    double suction() const { return suction_; }
    double saturation() const { return saturation_; }

private:
    double* rows_;
    const double* strain_;
    double suction_;
    double saturation_;
};

inline bool is_active(const MaterialBatch& batch, std::size_t bond)
{
    return (batch.active[bond / pack_width] >> bond % pack_width & 1u) != 0;
}

/// An array for the routine, followed by numbers that are none: what reads past the end gets them, and what writes past
/// the end is noticed.
class GuardedArray {
public:
    explicit GuardedArray(std::size_t largest) : values_(largest + guard) {}

    /// Sets the size, at most the largest, for the next call. What stands in the array is undefined then.
    double* resize(std::size_t size)
    {
        size_ = size;
        std::fill_n(values_.begin() + static_cast<std::ptrdiff_t>(size), guard,
                    std::numeric_limits<double>::quiet_NaN());
        return values_.data();
    }
    double* data() { return values_.data(); }
    bool overrun() const
    {
        const auto end = values_.begin() + static_cast<std::ptrdiff_t>(size_);
        return std::any_of(end, end + guard, [](double value) { return !std::isnan(value); });
    }

private:
    static constexpr std::ptrdiff_t guard = 64;
    std::vector<double> values_;
    std::size_t size_ = 0;
};

/// The calls of one thread at a time.
class RoutineCall {
public:
    explicit RoutineCall(const RoutineSettings& settings) : settings_(settings), properties_(settings.properties.size())
    {
        std::copy(settings.properties.begin(), settings.properties.end(),
                  properties_.resize(settings.properties.size()));
    }
    virtual ~RoutineCall() = default;
    RoutineCall(const RoutineCall&) = delete;
    RoutineCall& operator=(const RoutineCall&) = delete;

    /// Advances the active bonds of a batch, up to the first that fails. Owns nothing while the routine runs, which may
    /// stop for good.
    virtual void advance(const MaterialBatch& batch) = 0;

    RoutineFailure failure = RoutineFailure::none;
    std::size_t bond = 0; ///< the one in work, or the first of those in work together

protected:
    const RoutineSettings& settings() const { return settings_; }
    /// A copy, since some routines write on it.
    double* properties() { return properties_.data(); }

private:
    const RoutineSettings& settings_;
    GuardedArray properties_;
};

} // namespace periporo::abaqus
