// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
#include "diagnostics/dispersion.hpp"

#include "operator/refresh.hpp"

#include <cmath>
#include <numbers>

namespace periporo {

Model periodic_lattice(const LatticeMedium& medium, const std::array<int, 3>& cells, const ForceState& force_state)
{
    Model model;
    model.state.spacing = medium.spacing;
    model.state.horizon = medium.horizon;
    model.state.bodies.push_back({"lattice", medium.material, 1.0});
    model.state.points.resize(static_cast<std::size_t>(cells[0] * cells[1] * cells[2]));
    const double volume = std::pow(medium.spacing, 3);
    std::size_t at = 0;
    for (int k = 0; k < cells[2]; ++k)
        for (int j = 0; j < cells[1]; ++j)
            for (int i = 0; i < cells[0]; ++i, ++at) {
                Points& points = model.state.points;
                points.position[at] = points.initial_position[at] = medium.spacing * Vector3(i + 0.5, j + 0.5, k + 0.5);
                points.volume[at] = points.initial_volume[at] = volume;
                points.mass[at] = medium.density * volume;
                points.id[at] = static_cast<std::int64_t>(at);
            }
    model.allocate();
    std::vector<Isometry> shifts;
    for (int axis = 0; axis < 3; ++axis)
        shifts.push_back(Isometry::shift(axis, medium.spacing * cells[static_cast<std::size_t>(axis)]));
    model.neighbourhood.isometries.set_generators(shifts);
    find_first_families(model, force_state);
    return model;
}

double mode_frequency(Model& lattice, const ForceState& force_state, const Vector3& wave_vector,
                      const Vector3& polarisation)
{
    Points& points = lattice.state.points;
    for (std::size_t i = 0; i < lattice.size(); ++i)
        // the phase at the first point keeps waves at the edge of the zone from vanishing at every point
        points.velocity[i] = std::cos(wave_vector.dot(points.position[i] - points.position[0])) * polarisation;
    lattice.gather_ends();
    force_state.evaluate(lattice, {StressUpdate::tangent, MaterialResponse::elastic, 0.0});
    double stiffness = 0.0, mass = 0.0;
    for (std::size_t i = 0; i < lattice.size(); ++i) {
        stiffness -= lattice.result.internal_force[i].dot(points.velocity[i]);
        mass += points.mass[i] * points.velocity[i].squaredNorm();
    }
    return std::copysign(std::sqrt(std::abs(stiffness) / mass), stiffness);
}

std::vector<PhaseSpeed> dispersion(const LatticeMedium& medium, const ForceState& force_state, int cells)
{
    const double bulk = medium.material->bulk_modulus();
    const double shear = medium.material->shear_modulus();
    const double pressure_speed = std::sqrt((bulk + 4.0 / 3.0 * shear) / medium.density);
    const double shear_speed = std::sqrt(shear / medium.density);
    struct Course {
        WaveDirection direction;
        Vector3 along, across;
    };
    const Course courses[] = {{WaveDirection::axis, {1, 0, 0}, {0, 0, 1}},
                              {WaveDirection::face_diagonal, {1, 1, 0}, {0, 0, 1}},
                              {WaveDirection::space_diagonal, {1, 1, 1}, {1, -1, 0}}};
    std::vector<PhaseSpeed> curves;
    for (const Course& course : courses) {
        std::array<int, 3> box{};
        for (std::size_t axis = 0; axis < 3; ++axis)
            box[axis] = course.along[static_cast<Eigen::Index>(axis)] != 0.0 ? 2 * cells : 1;
        Model lattice = periodic_lattice(medium, box, force_state);
        for (const WaveType type : {WaveType::pressure, WaveType::shear})
            for (int n = 1; n <= cells; ++n) {
                const Vector3 k = (std::numbers::pi * n / (cells * medium.spacing)) * course.along;
                const bool is_pressure = type == WaveType::pressure;
                const Vector3 polarisation = (is_pressure ? course.along : course.across).normalized();
                const double omega = mode_frequency(lattice, force_state, k, polarisation);
                curves.push_back({course.direction, type, k.norm() * medium.spacing,
                                  omega / (k.norm() * (is_pressure ? pressure_speed : shear_speed))});
            }
    }
    return curves;
}

} // namespace periporo
