// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The reported moduli bound the stiffness of the law, on which the stable time step rests.
#pragma once

#include "periporo/kit/points.hpp"

#include <Eigen/Geometry>

namespace periporo::kit {

namespace detail {

/// Stiffness d : d sigma/(d : d) of the law against one small strain, measured from the answer to none [Pa].
inline double stiffness(const MaterialPoint& point, const SymmetricTensor<double>& strain, double time_step)
{
    MaterialPoint moved = point, rest = point;
    if (!moved.step(strain, time_step).converged || !rest.step({}, time_step).converged)
        return 0.0;
    return double_contraction(moved.stress() - rest.stress(), strain) / double_contraction(strain, strain);
}

inline SymmetricTensor<double> dyad(const Vector3& a, const Vector3& b)
{
    return {a.x() * b.x(),
            a.y() * b.y(),
            a.z() * b.z(),
            0.5 * (a.x() * b.y() + a.y() * b.x()),
            0.5 * (a.y() * b.z() + a.z() * b.y()),
            0.5 * (a.x() * b.z() + a.z() * b.x())};
}

/// Compares with K + 4/3 G in a random direction, and with 2 G across it if asked to.
inline std::string stiffness_fault(const MaterialPoint& point, double size, double tolerance, bool across,
                                   const Range& range, Random& random)
{
    const Material& material = point.material();
    const double longitudinal = material.bulk_modulus() + 4.0 / 3.0 * material.shear_modulus();
    const double transverse = 2.0 * material.shear_modulus();
    const Vector3 direction = Vector3(random.number(), random.number(), random.number()).normalized();
    const Vector3 normal = direction.cross(Vector3(random.number(), random.number(), random.number())).normalized();
    for (const double sign : {size, -size}) {
        const double along = stiffness(point, dyad(direction, direction) * sign, range.time_step);
        if (!(along <= longitudinal * (1.0 + tolerance)))
            return sentence("stiffness: a strain of ", sign, " in one direction at the stress ", text(point.stress()),
                            " Pa meets ", along, " Pa, more than the ", longitudinal * (1.0 + tolerance),
                            " Pa that K + 4/3 G = ", longitudinal, " Pa of the reported moduli allow");
        const double shear = across ? stiffness(point, dyad(direction, normal) * sign, range.time_step) : 0.0;
        if (!(shear <= transverse * (1.0 + tolerance)))
            return sentence("stiffness: a shear strain of ", sign, " at the stress ", text(point.stress()),
                            " Pa meets ", shear, " Pa, more than the ", transverse * (1.0 + tolerance),
                            " Pa that 2 G = ", transverse, " Pa of the reported moduli allow");
    }
    return {};
}

} // namespace detail

/// Probes the tangent by differences in random directions: at the states that paths start from against K + 4/3 G and
/// 2 G, and along random paths, where the law may flow, against K + 4/3 G.
inline Faults check_stiffness(const Material& material, const Range& range = {})
{
    constexpr double change = 1e-4;                  // of the stress by the probe, relative to p
    const double rounding = range.accuracy / change; // relative error of a stiffness by differences
    // Flow that does not follow the gradient of the yield function makes the law stiffer than its elasticity in some
    // directions: with theta the angle between the two, measured by elastic energy, by up to (1/cos(theta) - 1)/2, the
    // largest eigenvalue of the symmetric part of -m n^T/(m . n). A stable step of 0.85 of the elastic one, which is
    // the framework's, bears 1/0.85^2 - 1.
    constexpr double flowing = 0.38;
    Random random;
    for (const MaterialPoint& start : starting_points(material, range, random)) {
        const double probe = change * mean_pressure(start.stress()) / largest_stiffness(material);
        for (int n = 0; n < 10; ++n)
            if (std::string fault = detail::stiffness_fault(start, probe, rounding, true, range, random);
                !fault.empty())
                return {fault};
        for (const double size : range.strain_increments) {
            MaterialPoint point = start;
            for (int step = 0; step < 20; ++step) {
                const SymmetricTensor<double> strain = random.tensor(size);
                const MaterialPoint before = point;
                if (const MaterialStatus status = point.step(strain, range.time_step); !status.converged)
                    return {stopped("stiffness", before, strain, status)};
                // of stresses far above the first the probe moves a smaller part
                const double tolerance =
                    flowing + range.accuracy * norm(point.stress()) / (probe * largest_stiffness(material));
                if (std::string fault = detail::stiffness_fault(point, probe, tolerance, false, range, random);
                    !fault.empty())
                    return {fault};
            }
        }
    }
    return {};
}

} // namespace periporo::kit
