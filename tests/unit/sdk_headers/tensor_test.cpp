// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Tensor algebra against Eigen and against its own identities.
#include "periporo/tensor.hpp"

#include <doctest/doctest.h>

#include <Eigen/Dense>
#include <random>

using namespace periporo;

namespace {

using Matrix = Eigen::Matrix3d;

// Components of order one: a handful of products each, so 1e-14 is fifty roundings.
constexpr double tolerance = 1e-14;

class Random {
public:
    double number() { return distribution_(engine_); }

    SymmetricTensor<double> symmetric() { return {number(), number(), number(), number(), number(), number()}; }

    Tensor<double> general()
    {
        return {number(), number(), number(), number(), number(), number(), number(), number(), number()};
    }

private:
    std::mt19937_64 engine_{7};
    std::uniform_real_distribution<double> distribution_{-1.0, 1.0};
};

Matrix matrix(const SymmetricTensor<double>& a)
{
    return (Matrix() << a.xx, a.xy, a.xz, a.xy, a.yy, a.yz, a.xz, a.yz, a.zz).finished();
}

Matrix matrix(const Tensor<double>& a)
{
    return (Matrix() << a.xx, a.xy, a.xz, a.yx, a.yy, a.yz, a.zx, a.zy, a.zz).finished();
}

double largest(const Matrix& difference)
{
    return difference.cwiseAbs().maxCoeff();
}

} // namespace

TEST_CASE("trace, determinant, contraction and norm are those of the matrix")
{
    Random random;
    for (int n = 0; n < 100; ++n) {
        const auto a = random.symmetric(), b = random.symmetric();
        CHECK(trace(a) == doctest::Approx(matrix(a).trace()).epsilon(tolerance));
        CHECK(std::abs(determinant(a) - matrix(a).determinant()) <= tolerance);
        CHECK(std::abs(double_contraction(a, b) - (matrix(a) * matrix(b)).trace()) <= tolerance);
        CHECK(norm(a) == doctest::Approx(matrix(a).norm()).epsilon(tolerance));
    }
}

TEST_CASE("the deviator has no trace and differs by an isotropic tensor")
{
    Random random;
    for (int n = 0; n < 100; ++n) {
        const auto a = random.symmetric();
        const auto d = deviator(a);
        CHECK(std::abs(trace(d)) <= tolerance);
        CHECK(largest(matrix(a) - matrix(d) - Matrix::Identity() * trace(a) / 3.0) <= tolerance);
    }
}

TEST_CASE("a tensor times its adjugate is its determinant, singular or not")
{
    Random random;
    for (int n = 0; n < 100; ++n) {
        auto a = random.symmetric();
        if (n % 2 == 1) { // of rank one
            const double x = random.number(), y = random.number(), z = random.number();
            a = {x * x, y * y, z * z, x * y, y * z, x * z};
        }
        CHECK(largest(matrix(a) * matrix(adjugate(a)) - Matrix::Identity() * determinant(a)) <= tolerance);
    }
}

TEST_CASE("the products are those of the matrices")
{
    Random random;
    for (int n = 0; n < 100; ++n) {
        const auto a = random.general(), b = random.general();
        const auto s = random.symmetric();
        CHECK(largest(matrix(a * b) - matrix(a) * matrix(b)) <= tolerance);
        CHECK(largest(matrix(a * s) - matrix(a) * matrix(s)) <= tolerance);
        CHECK(largest(matrix(full(s)) - matrix(s)) == 0.0);
        CHECK(largest(matrix(symmetric_part(a)) - 0.5 * (matrix(a) + matrix(a).transpose())) <= tolerance);
    }
}

TEST_CASE("a tensor times its inverse is the identity")
{
    Random random;
    for (int n = 0; n < 100; ++n) {
        auto a = random.general();
        a += Tensor<double>::identity() * 4.0; // rows dominated by their diagonal: condition below 10
        CHECK(largest(matrix(a * inverse(a)) - Matrix::Identity()) <= tolerance);
        CHECK(largest(matrix(inverse(a) * a) - Matrix::Identity()) <= tolerance);
    }
}

TEST_CASE("rotated is b a b transposed for any b")
{
    Random random;
    for (int n = 0; n < 100; ++n) {
        const auto a = random.symmetric();
        const auto b = random.general();
        CHECK(largest(matrix(rotated(a, b)) - matrix(b) * matrix(a) * matrix(b).transpose()) <= tolerance);
    }
}

TEST_CASE("a rotation keeps the invariants")
{
    Random random;
    for (int n = 0; n < 100; ++n) {
        const auto a = random.symmetric();
        const Matrix q = Eigen::AngleAxisd(3.0 * random.number(), Vector3(0.6, 0.0, 0.8)).toRotationMatrix();
        const auto r =
            rotated(a, Tensor<double>{q(0, 0), q(0, 1), q(0, 2), q(1, 0), q(1, 1), q(1, 2), q(2, 0), q(2, 1), q(2, 2)});
        CHECK(std::abs(trace(r) - trace(a)) <= tolerance);
        CHECK(std::abs(norm(r) - norm(a)) <= tolerance);
        CHECK(std::abs(determinant(r) - determinant(a)) <= tolerance);
    }
}

TEST_CASE("tensors of packs give in every lane what tensors of doubles give")
{
    Random random;
    std::array<SymmetricTensor<double>, pack_width> s;
    std::array<Tensor<double>, pack_width> t;
    for (std::size_t lane = 0; lane < pack_width; ++lane) {
        s[lane] = random.symmetric();
        t[lane] = random.general() + Tensor<double>::identity() * 4.0;
    }
    const auto gather_s = [&](auto m) { return Pack([&](auto lane) { return s[lane].*m; }); };
    const auto gather_t = [&](auto m) { return Pack([&](auto lane) { return t[lane].*m; }); };
    using S = SymmetricTensor<double>;
    using T = Tensor<double>;
    const SymmetricTensor<Pack> packed_s{gather_s(&S::xx), gather_s(&S::yy), gather_s(&S::zz),
                                         gather_s(&S::xy), gather_s(&S::yz), gather_s(&S::xz)};
    const Tensor<Pack> packed_t{gather_t(&T::xx), gather_t(&T::xy), gather_t(&T::xz),
                                gather_t(&T::yx), gather_t(&T::yy), gather_t(&T::yz),
                                gather_t(&T::zx), gather_t(&T::zy), gather_t(&T::zz)};
    const auto rotated_pack = rotated(packed_s, packed_t);
    const auto inverse_pack = inverse(packed_t);
    const auto adjugate_pack = adjugate(packed_s);
    for (std::size_t lane = 0; lane < pack_width; ++lane) {
        const auto r = rotated(s[lane], t[lane]);
        const auto i = inverse(t[lane]);
        const auto a = adjugate(s[lane]);
        // the same operations up to fused multiply-adds, on numbers of up to 25 for the rotated
        CHECK(rotated_pack.xx[lane] == doctest::Approx(r.xx).epsilon(1e-13));
        CHECK(rotated_pack.yz[lane] == doctest::Approx(r.yz).epsilon(1e-13));
        CHECK(std::abs(inverse_pack.xy[lane] - i.xy) <= tolerance);
        CHECK(std::abs(inverse_pack.zz[lane] - i.zz) <= tolerance);
        CHECK(std::abs(adjugate_pack.xz[lane] - a.xz) <= tolerance);
    }
}
