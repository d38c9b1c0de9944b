// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Velocity gradients of points, as a field that both ends of a bond read.
#pragma once

#include "model/operator_result.hpp"
#include "operator/evaluation.hpp"
#include "operator/influence.hpp"

namespace periporo {

/// Sixteen doubles at every end of bonds. The first nine are a tensor row by row, which images hold in their own frame,
/// so that a bond reads it as it is.
class EndField {
public:
    static constexpr std::size_t values = 16;

    /// Doubles that a field takes.
    static std::size_t room(const Neighbourhood& neighbourhood) { return values * neighbourhood.ends(); }

    /// @param rows of room(neighbourhood) doubles
    EndField(const Neighbourhood& neighbourhood, double* rows) : neighbourhood_(neighbourhood), rows_(rows) {}

    double* operator[](std::size_t end) { return rows_ + end * values; }
    const double* operator[](std::size_t end) const { return rows_ + end * values; }

    /// Sets the values of images from those of their points.
    void fill_images();

private:
    const Neighbourhood& neighbourhood_;
    double* rows_;
};

/// K_i, L_i and w0_i of every point, as bond_projection.hpp defines them, and which bonds are active: those whose ends
/// are both sound and that are no shorter than shortest_bond spacings.
class PointGradients {
public:
    /// A row: L_i, 1/w0_i (0 without an active bond), K_i^-1 as xx yy zz xy yz xz (all zero where the point is not
    /// sound).
    enum Place : std::size_t { gradient_at = 0, reciprocal_weight_at = 9, inverse_shape_at = 10 };

    /// @param rows of EndField::room() doubles
    PointGradients(const OperatorInput& input, const Influence& influence, double* rows, OperatorResult& result);

    /// Finds everything anew; writes the activity of bonds and points to the result.
    void find();

    const double* operator[](std::size_t point) const { return rows_[point]; }

private:
    bool sound(std::size_t point) const { return rows_[point][inverse_shape_at] != 0.0; }
    bool find_gradient(std::size_t point);
    double find_activity(std::size_t point);

    const OperatorInput& input_;
    OperatorResult& result_;
    const Influence& influence_;
    double least_squared_; ///< of the length of an active bond [m2]
    EndField rows_;
};

/// Nine doubles as a tensor row by row, and back.
inline Tensor<double> tensor_at(const double* c)
{
    return {c[0], c[1], c[2], c[3], c[4], c[5], c[6], c[7], c[8]};
}
inline void store_tensor(const Tensor<double>& t, double* c)
{
    for (const double component : {t.xx, t.xy, t.xz, t.yx, t.yy, t.yz, t.zx, t.zy, t.zz})
        *c++ = component;
}

} // namespace periporo
