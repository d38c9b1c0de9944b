// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Drives a material law alone: one point along paths of prescribed strain and stress.
#pragma once

#include "periporo/kit/parameters.hpp"
#include "periporo/material_law.hpp"

#include <Eigen/LU>

#include <array>
#include <cmath>
#include <map>
#include <random>
#include <stdexcept>

namespace periporo::test {

/// The parameter values a law of numbers is built from: `given` over the defaults of its records, ranges checked.
inline Parameters parameter_values(const std::vector<Parameter>& records, const std::map<std::string, double>& given)
{
    return kit::parameters_of(records, {given.begin(), given.end()});
}

using Stress = SymmetricTensor<double>;
using Strain = SymmetricTensor<double>;
using Components = Eigen::Matrix<double, 6, 1>;

inline Components components(const SymmetricTensor<double>& a)
{
    return (Components() << a.xx, a.yy, a.zz, a.xy, a.yz, a.xz).finished();
}

inline SymmetricTensor<double> tensor(const Components& c)
{
    return {c[0], c[1], c[2], c[3], c[4], c[5]};
}

/// Mean stress, compression positive [Pa].
inline double mean_stress(const Stress& stress)
{
    return -trace(stress) / 3.0;
}

/// q = sqrt(3/2)|dev sigma| [Pa].
inline double shear_stress(const Stress& stress)
{
    return std::sqrt(1.5) * norm(deviator(stress));
}

/// One point of a material, advanced step by step.
template <class Law>
struct MaterialPoint {
    Law law;
    LawInput<double, Law::state_count> now{};
    Strain strain; // since the start

    MaterialPoint(const Law& the_law, const Stress& stress, double time_step = 1e-4) : law(the_law)
    {
        now.stress = stress;
        now.time_step = time_step;
    }

    LawResult<double, Law::state_count> response(const Strain& increment) const
    {
        LawInput<double, Law::state_count> input = now;
        input.strain_increment = increment;
        return law.update(input);
    }

    void step(const Strain& increment)
    {
        const auto result = response(increment);
        if (result.failed)
            throw std::runtime_error(result.reason);
        now.stress = result.stress;
        now.state = result.state;
        strain += increment;
    }

    /// A step in which the components marked in `held` keep their stress and the others follow `increment`. The
    /// strains of the held ones are found by Newton's method to `tolerance` [Pa].
    void step_holding_stress(const std::array<bool, 6>& held, const Strain& increment, double tolerance)
    {
        Components strains = components(increment);
        const Components start = components(now.stress);
        for (int iteration = 0; iteration < 50; ++iteration) {
            const Components stresses = components(response(tensor(strains)).stress);
            Components residual = Components::Zero();
            Eigen::Matrix<double, 6, 6> tangent = Eigen::Matrix<double, 6, 6>::Identity();
            for (int c = 0; c < 6; ++c)
                if (held[c])
                    residual[c] = stresses[c] - start[c];
            if (residual.cwiseAbs().maxCoeff() <= tolerance) {
                step(tensor(strains));
                return;
            }
            for (int d = 0; d < 6; ++d) {
                if (!held[d])
                    continue;
                Components probe = strains;
                const double h = 1e-7 * (1e-3 + strains.cwiseAbs().maxCoeff());
                probe[d] += h;
                const Components change = (components(response(tensor(probe)).stress) - stresses) / h;
                for (int c = 0; c < 6; ++c)
                    if (held[c])
                        tangent(c, d) = change[c];
            }
            strains -= tangent.partialPivLu().solve(residual);
        }
        throw std::runtime_error("the mixed step did not converge");
    }
};

/// A random number in [-1, 1], a random tensor and a random rotation, the same in every run.
class Random {
public:
    double number() { return distribution_(engine_); }
    double number(double low, double high) { return low + 0.5 * (number() + 1.0) * (high - low); }

    SymmetricTensor<double> tensor(double size)
    {
        return {size * number(), size * number(), size * number(), size * number(), size * number(), size * number()};
    }

    Tensor<double> rotation()
    {
        double w = number(), x = number(), y = number(), z = number();
        const double length = std::sqrt(w * w + x * x + y * y + z * z);
        w /= length, x /= length, y /= length, z /= length;
        return {1 - 2 * (y * y + z * z), 2 * (x * y - w * z),     2 * (x * z + w * y),
                2 * (x * y + w * z),     1 - 2 * (x * x + z * z), 2 * (y * z - w * x),
                2 * (x * z - w * y),     2 * (y * z + w * x),     1 - 2 * (x * x + y * y)};
    }

private:
    std::mt19937_64 engine_{20260101};
    std::uniform_real_distribution<double> distribution_{-1.0, 1.0};
};

} // namespace periporo::test
