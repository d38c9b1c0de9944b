// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The surface of a deformable body as another body feels it: smooth, although it is made of points.
#pragma once

#include "model/model.hpp"

#include <cstdint>
#include <vector>

namespace periporo {

/// What a point would stand on.
struct Support {
    Vector3 normal = Vector3::Zero();   ///< of the surface, outwards
    double distance = 0.0;              ///< of the point above the surface [m]
    std::vector<std::uint32_t> records; ///< points and images of the surface
    std::vector<double> weights;        ///< of each; they sum to 1
};

/// The surface is a plane fitted to the surface points near the foot of the point that looks for it, by moving least
/// squares (Lancaster and Salkauskas, Math. Comp. 37, 1981): weights w_c with
///
///     sum w_c = 1,   sum w_c (x_c - x_i) has no part along the surface,
///
/// so that a reaction f n on point i, and -w_c f n on those of the surface, has neither a resultant nor a moment: the
/// mean of the surface points lies straight below the point. The normal is the mean of the surface points' own, each
/// pointing away from the family of its point. The surface lies half a spacing outside its points.
class SmoothedSurface {
public:
    /// Finds the surface of a body, and which points of another are near. To be called after every refresh.
    /// @param reach of the contact law above the surface [m]
    /// @param slack how much closer points may come until the next call [m]
    void find(const Model& model, std::uint32_t surface_body, std::uint32_t other_body, double reach, double slack);

    /// Points of the other body that may touch before the next call.
    const std::vector<std::uint32_t>& near() const { return near_; }
    /// What near()[n] stands on, at the present positions.
    /// @return false when there is no surface below it.
    bool find_support(const Model& model, std::size_t n, Support& support) const;

private:
    struct Node {
        std::uint32_t record;
        Vector3 normal;
    };
    std::vector<Node> nodes_;               ///< points and images of the surface
    std::vector<std::uint32_t> near_;       ///< of the other body
    std::vector<std::size_t> first_;        ///< of near_[n], in candidates_
    std::vector<std::uint32_t> candidates_; ///< in nodes_
    double reach_ = 0.0;                    ///< of nodes around a point that touches [m]
};

} // namespace periporo
