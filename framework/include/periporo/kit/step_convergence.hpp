// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Cut into ever shorter steps, a strain path leads to one stress, at first order or faster.
#pragma once

#include "periporo/kit/points.hpp"
#include "periporo/material_law.hpp"

#include <array>

namespace periporo::kit {

namespace detail {

/// The stresses at the ends of `marks` equal parts of a straight strain path, each part taken in `cuts` steps over the
/// time step of the range in all.
inline MaterialStatus walk(MaterialPoint point, const SymmetricTensor<double>& strain, int marks, int cuts,
                           const Range& range, std::vector<SymmetricTensor<double>>& stresses)
{
    stresses.clear();
    for (int mark = 0; mark < marks; ++mark) {
        for (int cut = 0; cut < cuts; ++cut)
            if (const MaterialStatus status = point.step(strain * (1.0 / (marks * cuts)), range.time_step / cuts);
                !status.converged)
                return status;
        stresses.push_back(point.stress());
    }
    return {};
}

} // namespace detail

/// Isotropic, oedometric and isochoric compression from isotropic stress, as far as an elastic material would change
/// its stress by four times p, in 16, 32, ... 256 steps. The largest differences d0, d1, d2, d3 between a path and the
/// same with half the steps must fall at first order. Two thirds count as one, since a yield point falls into a step
/// where chance wants it: d3 <= d0 2^(-3 2/3), or, when d0 is small by chance, d3 <= d1 2^(-2 2/3).
inline Faults check_step_convergence(const Material& material, const Range& range = {})
{
    constexpr int marks = 16;
    constexpr double length = 4.0; // a yield point lies within, and the longest step is a quarter of p
    struct Direction {
        const char* name;
        SymmetricTensor<double> strain;
    };
    const Direction directions[] = {{"isotropic", {-0.577, -0.577, -0.577, 0.0, 0.0, 0.0}},
                                    {"oedometric", {0.0, 0.0, -1.0, 0.0, 0.0, 0.0}},
                                    {"isochoric", {0.408, 0.408, -0.816, 0.0, 0.0, 0.0}}};
    for (const double pressure : range.pressures)
        for (const Direction& direction : directions) {
            const MaterialPoint start = starting_point(material, range, SymmetricTensor<double>::isotropic(-pressure));
            const SymmetricTensor<double> elastic =
                elastic_stress<double>({}, direction.strain, material.bulk_modulus(), material.shear_modulus());
            const SymmetricTensor<double> strain = direction.strain * (length * pressure / norm(elastic));
            std::array<double, 4> differences{};
            std::vector<SymmetricTensor<double>> coarse, fine;
            double largest = 0.0;
            for (std::size_t level = 0; level <= differences.size(); ++level) {
                if (const MaterialStatus status = detail::walk(start, strain, marks, 1 << level, range, fine);
                    !status.converged)
                    return {stopped("step convergence", start, strain * (1.0 / (marks << level)), status)};
                for (std::size_t m = 0; m < fine.size(); ++m) {
                    largest = std::max(largest, norm(fine[m]));
                    if (level > 0)
                        differences[level - 1] = std::max(differences[level - 1], norm(fine[m] - coarse[m]));
                }
                coarse.swap(fine);
            }
            const double round_off =
                range.accuracy * (largest + stress_scale(material, start.stress(), strain * (1.0 / marks)));
            if (!(differences[3] <= std::max({0.25 * differences[0], 0.397 * differences[1], round_off})))
                return {sentence("step convergence: along ", direction.name, " compression by ", norm(strain),
                                 " from p = ", pressure, " Pa the stress changes by ", differences[0], ", ",
                                 differences[1], ", ", differences[2], " and ", differences[3],
                                 " Pa when 16, 32, 64 and 128 steps are halved; at first order each is half of the "
                                 "one before")};
        }
    return {};
}

} // namespace periporo::kit
