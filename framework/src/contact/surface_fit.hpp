// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// A plane through points by weighted least squares, and its derivatives by their places.
#pragma once

#include "periporo/tensor.hpp"

#include <Eigen/Core>

namespace periporo {

/// Weight of a point at a distance, smooth and zero from the radius on.
struct Bell {
    double value;
    double slope; ///< derivative by the square of the distance over that of the radius
};

inline Bell bell(double squared_distance)
{
    const double left = 1.0 - squared_distance;
    return left > 0.0 ? Bell{left * left, -2.0 * left} : Bell{0.0, 0.0};
}

/// The plane through the mean c of points x_c with weights w_c, normal to the direction n in which they scatter least
/// (the surface of Adamson and Alexa, Proc. Symp. Geometry Processing 2003, 230-239). n is the eigenvector of the least
/// eigenvalue mu_1 of sum w (x_c - c)(x_c - c)^T. `spread` is (mu_2 - mu_1)(mu_3 - mu_1)/(mu_2 + mu_3 - 2 mu_1): large
/// where many points lie in a plane and on all sides, 0 where they lie on one line or where they have no direction.
class PlaneFit {
public:
    void add(double weight, const Vector3& place)
    {
        weight_ += weight;
        first_ += weight * place;
        second_ += weight * place * place.transpose();
    }
    /// To be called when all points are there. Places are relative to the point whose height is asked for.
    /// @param outwards a direction on the side that the normal shall point to
    /// @return false when there is no plane.
    bool solve(const Vector3& outwards);

    const Vector3& normal() const { return normal_; }
    /// Of the point at the origin above the plane [m].
    double height() const { return height_; }
    double spread() const { return spread_; } ///< [m2]

    /// Part of a point in the plane straight below the origin: they sum to 1 with the weights.
    double part(const Vector3& place) const { return 1.0 / weight_ - tilt_.dot(place - mean_); }
    /// Derivatives by the weight and by the place of a point with the weight w, for that by the place over w.
    struct Slope {
        double by_weight;
        Vector3 by_place;
    };
    Slope slope_of_height(const Vector3& place) const
    {
        const Vector3 apart = place - mean_;
        const double across = apart.dot(normal_);
        const double lever = tilt_.dot(apart) - 1.0 / weight_;
        return {across * lever, lever * normal_ + across * tilt_};
    }
    Slope slope_of_spread(const Vector3& place) const
    {
        const Vector3 apart = place - mean_;
        const Vector3 turned = spread_slopes_ * apart;
        return {apart.dot(turned), 2.0 * turned};
    }

private:
    double weight_ = 0.0;
    Vector3 first_ = Vector3::Zero();
    Eigen::Matrix3d second_ = Eigen::Matrix3d::Zero();
    Vector3 mean_ = Vector3::Zero();
    Vector3 normal_ = Vector3::Zero();
    double height_ = 0.0;
    double spread_ = 0.0;
    Vector3 tilt_ = Vector3::Zero();                          ///< of the plane, by the scatter: (C - mu_1)^+ c [1/m]
    Eigen::Matrix3d spread_slopes_ = Eigen::Matrix3d::Zero(); ///< derivative of the spread by the scatter
};

} // namespace periporo
