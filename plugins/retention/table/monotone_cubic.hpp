// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Interpolation that rises and falls only where its nodes do.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace periporo {

/// Piecewise cubic through nodes (x, y), with a continuous slope and without overshoot: inside, the slope at a node is
/// the harmonic mean of the secants beside it, weighted after Fritsch and Butland (1984), and zero at a plateau; at
/// both ends that of a parabola through three nodes, or zero when it points the other way. No slope is more than three
/// times a secant beside it, so each piece is monotone (Fritsch and Carlson 1980).
class MonotoneCubic {
public:
    /// @param x at least one, strictly rising
    /// @param y one for each x, all falling or level, or all rising or level
    MonotoneCubic(std::vector<double> x, std::vector<double> y) : x_(std::move(x)), y_(std::move(y))
    {
        const std::size_t pieces = x_.size() - 1;
        for (std::size_t k = 0; k < pieces; ++k)
            secants_.push_back((y_[k + 1] - y_[k]) / (x_[k + 1] - x_[k]));
        if (pieces == 0)
            return;
        slopes_.push_back(pieces == 1 ? secants_[0] : end_slope(0, 1));
        for (std::size_t k = 1; k < pieces; ++k)
            slopes_.push_back(inner_slope(k));
        slopes_.push_back(pieces == 1 ? secants_[0] : end_slope(pieces - 1, pieces - 2));
    }

    /// At the nodes exactly their y; beyond the last node its y.
    /// @param at not before the first node
    double operator()(double at) const
    {
        if (at >= x_.back())
            return y_.back();
        const auto next = std::upper_bound(x_.begin(), x_.end(), at);
        const auto k = static_cast<std::size_t>(next - x_.begin()) - 1;
        if (secants_[k] == 0.0)
            return y_[k];
        const double a = slopes_[k] / secants_[k];
        const double b = slopes_[k + 1] / secants_[k];
        const double t = (at - x_[k]) / (x_[k + 1] - x_[k]);
        const double part = t * (a + t * (3.0 - 2.0 * a - b + t * (a + b - 2.0))); // 0 to 1 with the slopes a and b
        return std::lerp(y_[k], y_[k + 1], std::clamp(part, 0.0, 1.0));
    }

private:
    double width(std::size_t piece) const { return x_[piece + 1] - x_[piece]; }

    double inner_slope(std::size_t node) const
    {
        const double before = secants_[node - 1], after = secants_[node];
        if (before * after <= 0.0)
            return 0.0;
        const double weight = (1.0 + width(node) / (width(node - 1) + width(node))) / 3.0; // of the piece before
        return 1.0 / (weight / before + (1.0 - weight) / after);
    }

    /// @param piece the first or the last, and `inward` the one beside it
    double end_slope(std::size_t piece, std::size_t inward) const
    {
        const double change = (secants_[piece] - secants_[inward]) / (width(piece) + width(inward));
        const double slope = secants_[piece] + change * width(piece);
        return slope * secants_[piece] > 0.0 ? slope : 0.0;
    }

    std::vector<double> x_;
    std::vector<double> y_;
    std::vector<double> secants_; // of the pieces
    std::vector<double> slopes_;  // at the nodes
};

} // namespace periporo
