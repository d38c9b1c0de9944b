// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Small models for tests: lattices, random clouds, and an elastic material without a plugin.
#pragma once

#include "model/model.hpp"
#include "operator/force_state.hpp"
#include "operator/refresh.hpp"
#include "periporo/material_law.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>
#include <functional>
#include <memory>
#include <numeric>
#include <random>
#include <vector>

namespace specimens {

using namespace periporo;

/// Hooke's law with moduli fixed by the test.
struct Hooke {
    static constexpr std::size_t state_count = 0;
    static std::vector<Parameter> parameters() { return {}; }
    static std::vector<StateVariable> state_variables() { return {}; }
    explicit Hooke(const Parameters&) {}
    double bulk_modulus() const { return 2.0e6; }
    double shear_modulus() const { return 1.2e6; }
    template <class Real>
    LawResult<Real, 0> update(const LawInput<Real, 0>& old) const
    {
        return {elastic_stress(old.stress, old.strain_increment, bulk_modulus(), shear_modulus()), {}};
    }
    template <class Real>
    std::array<Real, 0> initial_state(const LawInput<Real, 0>&, double) const
    {
        return {};
    }
};

inline constexpr double density = 1800.0; // [kg/m3]

inline Model from_positions(const std::vector<Vector3>& positions, double spacing, double horizon_ratio = 3.015)
{
    Model model;
    model.state.spacing = spacing;
    model.state.horizon = horizon_ratio * spacing;
    model.state.bodies.push_back({"body", std::make_shared<LawMaterial<Hooke>>(Parameters{}), 1.0});
    model.state.points.resize(positions.size());
    for (std::size_t i = 0; i < positions.size(); ++i) {
        model.state.points.position[i] = model.state.points.initial_position[i] = positions[i];
        model.state.points.volume[i] = model.state.points.initial_volume[i] = spacing * spacing * spacing;
        model.state.points.mass[i] = density * model.state.points.volume[i];
        model.state.points.id[i] = static_cast<std::int64_t>(i);
    }
    model.allocate();
    return model;
}

/// nx x ny x nz points at cell centres, lower corner at the origin.
inline std::vector<Vector3> lattice(int nx, int ny, int nz, double spacing)
{
    std::vector<Vector3> positions;
    for (int k = 0; k < nz; ++k)
        for (int j = 0; j < ny; ++j)
            for (int i = 0; i < nx; ++i)
                positions.push_back(spacing * Vector3(i + 0.5, j + 0.5, k + 0.5));
    return positions;
}

/// A lattice whose points are moved by up to `amount` spacings in every direction.
inline std::vector<Vector3> jittered(std::vector<Vector3> positions, double spacing, double amount, unsigned seed = 7)
{
    std::mt19937 generator(seed);
    std::uniform_real_distribution<double> shift(-amount * spacing, amount * spacing);
    for (Vector3& x : positions)
        x += Vector3(shift(generator), shift(generator), shift(generator));
    return positions;
}

/// Sets velocities by position and prepares the records for an evaluation.
inline void set_velocity(Model& model, const std::function<Vector3(const Vector3&)>& velocity)
{
    for (std::size_t i = 0; i < model.size(); ++i)
        model.state.points.velocity[i] = velocity(model.state.points.position[i]);
    model.gather_ends();
}

/// One value of the state of bond b of a point: row 0..5 stress, then state variables.
inline double& bond_value(Model& model, std::size_t point, std::size_t bond, std::size_t row)
{
    return model.bond_state(point, bond)[row * pack_width];
}

/// Sets the stress of every bond.
inline void set_stress(Model& model, const std::function<SymmetricTensor<double>(std::size_t, std::size_t)>& stress)
{
    for (std::size_t i = 0; i < model.size(); ++i)
        for (std::size_t b = 0; b < model.neighbourhood.families[i].count; ++b) {
            const SymmetricTensor<double> s = stress(i, b);
            for (std::size_t c = 0; c < 6; ++c)
                bond_value(model, i, b, c) = components(s)[c];
        }
}

inline bool is_active(const Model& model, std::size_t point, std::size_t bond)
{
    return model.result.active.holds(model.neighbourhood.families[point], bond);
}

/// Every force state with every influence function, built for a horizon.
template <class Test>
void for_every_operator(double horizon, Test&& test)
{
    for (const std::string& state : force_state_names())
        for (const std::string& influence : influence_names())
            test(state, influence, *make_force_state(state, Influence::by_name(influence, horizon)));
}

inline Eigen::Matrix3d matrix(const SymmetricTensor<double>& s)
{
    Eigen::Matrix3d m;
    m << s.xx, s.xy, s.xz, s.xy, s.yy, s.yz, s.xz, s.yz, s.zz;
    return m;
}

/// sum_i f_i (x) x_i [J]
inline Eigen::Matrix3d force_moment(const Model& model)
{
    Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
    for (std::size_t i = 0; i < model.size(); ++i)
        sum += model.result.internal_force[i] * model.state.points.position[i].transpose();
    return sum;
}

} // namespace specimens
