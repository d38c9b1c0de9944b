// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The linear algebra of a material point: the one source that compiles Eigen's orthogonal decomposition.
#include "periporo/material_point.hpp"

#include <Eigen/QR>

namespace periporo {

Eigen::VectorXd shortest_solution(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& right, double zero)
{
    Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> decomposition(matrix.rows(), matrix.cols());
    decomposition.setThreshold(zero);
    decomposition.compute(matrix);
    return decomposition.solve(right);
}

} // namespace periporo
