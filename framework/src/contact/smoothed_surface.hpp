// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// A smooth surface through the outer points of a deformable body.
#pragma once

#include "contact/surface_fit.hpp"
#include "model/model.hpp"

#include <cstdint>
#include <vector>

namespace periporo {

/// The part of a surface that supports a point: a plane.
struct Support {
    Vector3 normal = Vector3::Zero();             ///< of the surface, outwards
    double distance = 0.0;                        ///< of the point above the surface [m]
    double strength = 0.0;                        ///< 1 inside the surface, falling to 0 beyond its rim
    std::vector<std::uint32_t> ends;              ///< points and images of the surface
    std::vector<double> weights;                  ///< of each; they sum to 1, and friction is shared by them
    Vector3 own_slope = Vector3::Zero();          ///< derivative of the distance by the place of the point
    std::vector<Vector3> slopes;                  ///< and by the place of each end
    Vector3 own_strength_slope = Vector3::Zero(); ///< derivative of the strength by the place of the point [1/m]
    std::vector<Vector3> strength_slopes;         ///< and by the place of each end [1/m]
};

/// The surface is a plane fitted to the surface points around the point that looks for it, half a spacing outside them:
/// see PlaneFit. The distance and the strength are functions of the places alone, between two calls of find(). A
/// contact whose energy is strength times that of its law, with the slopes as reactions, so keeps energy, momentum and
/// moment of momentum.
///
/// find() chooses the surface points: those that no other point of their body covers, on the side of the body that
/// faces the other point. Each has a share from 0 to 1 that changes smoothly with the places.
class SmoothedSurface {
public:
    /// Finds the surface of a body, and which points of another are near. To be called after every refresh.
    /// @param reach of the contact law above the surface [m]
    /// @param slack how much closer points may come until the next call [m]
    void find(const Model& model, std::uint32_t surface_body, std::uint32_t other_body, double reach, double slack);

    /// Points of the other body that may touch before the next call of find().
    const std::vector<std::uint32_t>& near() const { return near_; }
    /// Finds the support of near()[n] at the present positions.
    /// @return false when there is no surface below it.
    bool find_support(const Model& model, std::size_t n, Support& support) const;

private:
    struct Node {
        std::uint32_t end;
        Vector3 normal;
        double share;
    };
    void find_nodes(const Model& model, std::uint32_t surface_body);
    /// Of the candidates of near_[n], at the present positions; not solved yet.
    PlaneFit fit(const Model& model, std::size_t n) const;
    /// Sets outward_[n] and the shares of its candidates.
    void set_shares(const Model& model, std::size_t n, double slack);

    std::vector<Node> nodes_;               ///< points and images of the surface
    std::vector<std::uint32_t> near_;       ///< of the other body
    std::vector<std::size_t> first_;        ///< of near_[n], in candidates_
    std::vector<std::uint32_t> candidates_; ///< in nodes_
    std::vector<double> shares_;            ///< of each candidate, for the point that it is one of
    std::vector<Vector3> outward_;          ///< for each of near_, roughly
    double spacing_ = 0.0;                  ///< [m]
    double reach_ = 0.0;                    ///< of nodes around a point that touches [m]
};

} // namespace periporo
