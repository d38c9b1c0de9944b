// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Mid-step gradient and rotation of a step.
#include "operator/bond_update.hpp"

#include <doctest/doctest.h>

using namespace periporo;

TEST_CASE("the rotation of a step is orthogonal and turns by twice the arctangent of half the angle")
{
    const double dt = 0.1, rate = 3.0;
    Tensor<double> spin;
    spin.xy = -rate;
    spin.yx = rate;
    const Tensor<double> r = step_rotation(spin, dt);
    const double angle = 2.0 * std::atan(0.5 * rate * dt); // Cayley transform
    CHECK(r.xx == doctest::Approx(std::cos(angle)).epsilon(1e-15));
    CHECK(r.yx == doctest::Approx(std::sin(angle)).epsilon(1e-15));
    CHECK(r.xy == doctest::Approx(-std::sin(angle)).epsilon(1e-15));
    CHECK(r.zz == 1.0);
}

TEST_CASE("the gradient at mid-step recovers a finite rotation from the end positions: no strain, whatever the angle")
{
    // x_end = R x_begin at constant velocity v = (x_end - x_begin)/dt
    const double dt = 0.2, angle = 0.7;
    const double c = std::cos(angle), s = std::sin(angle);
    Tensor<double> r = Tensor<double>::identity();
    r.xx = r.yy = c;
    r.xy = -s;
    r.yx = s;
    Tensor<double> gradient = inverse(r) * -1.0; // dv/dx_end = (1 - R^-1)/dt
    gradient.xx += 1.0, gradient.yy += 1.0, gradient.zz += 1.0;
    gradient *= 1.0 / dt;
    const Tensor<double> mid = at_mid_step(gradient, dt);
    CHECK(norm(symmetric_part(mid)) < 1e-14 / dt);
    CHECK(step_rotation(mid, dt).yx == doctest::Approx(s).epsilon(1e-14));
}

TEST_CASE("the strain of a step of uniaxial stretch is 2 (l1 - l0)/(l1 + l0)")
{
    const double dt = 0.5, l0 = 1.0, l1 = 1.3;
    Tensor<double> gradient;
    gradient.xx = (l1 - l0) / dt / l1; // dv/dx_end
    CHECK(at_mid_step(gradient, dt).xx * dt == doctest::Approx(2.0 * (l1 - l0) / (l1 + l0)).epsilon(1e-15));
}
