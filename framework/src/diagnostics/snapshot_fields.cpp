// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
#include "diagnostics/snapshot_fields.hpp"

#include "operator/refresh.hpp"
#include "water/mixture.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <numeric>

namespace periporo {
namespace {

std::span<const double> flat(const std::vector<Vector3>& vectors)
{
    return {vectors.empty() ? nullptr : vectors.front().data(), 3 * vectors.size()};
}

} // namespace

void SnapshotFields::add_real(std::string name, std::string unit, std::string description, std::size_t components,
                              std::vector<double> values)
{
    reals_.push_back(std::move(values));
    fields_.push_back({std::move(name), std::move(unit), std::move(description), components, reals_.back(), {}});
}

void SnapshotFields::add_integer(std::string name, std::string description, std::vector<std::int64_t> values)
{
    integers_.push_back(std::move(values));
    fields_.push_back({std::move(name), "-", std::move(description), 1, {}, integers_.back()});
}

void SnapshotFields::add_volumes(const Model& model)
{
    const Points& points = model.state.points;
    const std::size_t n = model.size();
    fields_.push_back({"volume",
                       "m3",
                       "V, volume of the soil of the point: its weight in the sums of the operator",
                       1,
                       points.volume,
                       {}});
    std::vector<double> ratio(n), gap(n), density(n), porosity(n);
    for (std::size_t i = 0; i < n; ++i) {
        ratio[i] = points.volume[i] / points.initial_volume[i];
        gap[i] = std::max(0.0, points.jacobian[i] - ratio[i]);
        density[i] = points.mass[i] / points.volume[i];
        porosity[i] = porosity_of(model, i);
    }
    add_real("volume_ratio", "-", "V/V0, current over initial volume of the soil; 1 - phi0 to 1.25", 1,
             std::move(ratio));
    add_real("gap_ratio", "-", "volume of gaps between grains over V0: J - V/V0 where J > 1.25, else 0", 1,
             std::move(gap));
    add_real("density", "kg/m3", "mass of grains and water over V", 1, std::move(density));
    add_real("porosity", "-", "phi = 1 - (1 - phi0) V0/V", 1, std::move(porosity));
}

const std::vector<FieldView>& SnapshotFields::collect(const Model& model, const ForceState& force_state)
{
    const Points& points = model.state.points;
    const std::size_t n = model.size();
    reals_.clear();
    integers_.clear();
    fields_.clear();
    // Views point into these: no reallocation of the outer vectors after the first is added moves the inner data.
    fields_.push_back({"velocity", "m/s", "velocity of the point", 3, flat(points.velocity), {}});
    std::vector<double> displacement(3 * n);
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t c = 0; c < 3; ++c)
            displacement[3 * i + c] = points.position[i][static_cast<Eigen::Index>(c)] -
                                      points.initial_position[i][static_cast<Eigen::Index>(c)];
    add_real("displacement", "m", "position minus position at the start of the run", 3, std::move(displacement));
    add_volumes(model);

    std::vector<double> states = model.state.point_states.values;
    mean_point_states(model, force_state, states);
    std::vector<double> stress(6 * n);
    for (std::size_t i = 0; i < n; ++i)
        std::copy_n(states.data() + i * model.state.point_states.stride, 6, stress.data() + 6 * i);
    add_real(
        "effective_stress", "Pa",
        "effective Cauchy stress, tension positive, mean over the active bonds of the point; components xx, yy, zz, "
        "xy, yz, xz",
        6, std::move(stress));
    for (std::size_t body = 0; body < model.state.bodies.size(); ++body) {
        const std::vector<StateVariable>& variables = model.state.bodies[body].material->state_variables();
        for (const StateVariable& variable : variables) {
            if (std::any_of(fields_.begin(), fields_.end(),
                            [&](const FieldView& f) { return f.name == variable.name; }))
                continue;
            std::vector<double> values(n, 0.0);
            for (std::size_t i = 0; i < n; ++i) {
                const std::vector<StateVariable>& own = model.body_of(i).material->state_variables();
                for (std::size_t s = 0; s < own.size(); ++s)
                    if (own[s].name == variable.name)
                        values[i] = states[i * model.state.point_states.stride + 6 + s];
            }
            add_real(variable.name, variable.unit, variable.description + "; mean over the active bonds of the point",
                     1, std::move(values));
        }
    }
    fields_.push_back({"pore_pressure",
                       "Pa",
                       "pressure of the pore water over that of the air, compression positive: minus the suction above "
                       "a water table, that of water at rest below it",
                       1,
                       points.pore_pressure,
                       {}});
    std::vector<double> suction(n);
    for (std::size_t i = 0; i < n; ++i)
        suction[i] = points.suction(i);
    add_real("suction", "Pa", "matric suction, positive; zero below a water table", 1, std::move(suction));
    fields_.push_back({"saturation", "-", "degree of saturation of water", 1, points.saturation, {}});
    std::vector<std::int64_t> family(n);
    for (std::size_t i = 0; i < n; ++i)
        family[i] = static_cast<std::int64_t>(model.neighbourhood.families[i].count);
    add_integer("family_size", "number of bonds of the point", std::move(family));
    add_integer("inactive_bonds", "bonds that carry no stress because their sub-horizon is degenerate",
                {model.result.inactive_bonds.begin(), model.result.inactive_bonds.end()});
    add_integer("free_grain", "1 where no bond is active",
                {model.result.detached.begin(), model.result.detached.end()});
    add_integer("body", "index of the body, in the order of the case", {points.body.begin(), points.body.end()});
    fields_.push_back({"id", "-", "number of the point within its body", 1, {}, points.id});
    return fields_;
}

std::vector<HistoryColumn> history_columns(const Model& model)
{
    std::vector<HistoryColumn> columns{
        {"time", "s", "since the start of the first dynamic stage"},
        {"time_step", "s", "step of the time integration"},
        {"kinetic_energy", "J", "sum of m v^2/2"},
        {"gravity_energy", "J", "potential energy relative to the release"},
        {"stress_work", "J", "work of the stress on the deformation: stored and dissipated in the material"},
        {"contact_energy", "J", "stored in contacts"},
        {"friction_work", "J", "dissipated by friction"},
        {"collision_work", "J", "dissipated in the normal direction of contacts"},
        {"boundary_work", "J",
         "done on the bodies by moving points and obstacles and by the lift of standing water, and kinetic energy of "
         "water that came"},
        {"energy_error", "J", "sum of the energies minus their sum at the release and the boundary work"},
        {"maximum_speed", "m/s", "largest speed of a point"},
        {"front", "m",
         "largest horizontal distance of a point from the vertical axis through the origin; points of a body whose "
         "surface others touch do not count"},
        {"height", "m", "largest vertical coordinate of such a point plus half a spacing"},
        {"inactive_bonds", "-", "bonds that carry no stress because their sub-horizon is degenerate"},
        {"free_grains", "-", "points without an active bond"}};
    for (const Obstacle& obstacle : model.state.obstacles)
        for (const char axis : {'x', 'y', 'z'}) {
            columns.push_back({fmt::format("{}_force_{}", obstacle.name, axis), "N",
                               fmt::format("force on obstacle '{}', of the points that are computed, without images",
                                           obstacle.name)});
            columns.push_back({fmt::format("{}_shift_{}", obstacle.name, axis), "m",
                               fmt::format("how far obstacle '{}' has moved", obstacle.name)});
        }
    return columns;
}

std::vector<double> history_row(const Model& model, const Dynamics& dynamics, double time, double time_step)
{
    double speed = 0.0;
    double front = 0.0;
    double height = -std::numeric_limits<double>::infinity();
    const bool ground_alone = std::ranges::all_of(model.state.bodies, &Body::ground);
    for (std::size_t i = 0; i < model.size(); ++i) {
        const Vector3& x = model.state.points.position[i];
        speed = std::max(speed, model.state.points.velocity[i].norm());
        if (model.body_of(i).ground && !ground_alone)
            continue;
        front = std::max(front, std::hypot(x.x(), x.y()));
        height = std::max(height, x.z() + 0.5 * model.state.spacing);
    }
    const EnergyLedger& ledger = dynamics.ledger();
    std::vector<double> row{time,
                            time_step,
                            ledger.kinetic,
                            ledger.gravity,
                            ledger.stress_work,
                            ledger.contact,
                            ledger.friction,
                            ledger.collision,
                            ledger.boundary,
                            ledger.error(),
                            speed,
                            front,
                            height,
                            static_cast<double>(std::accumulate(model.result.inactive_bonds.begin(),
                                                                model.result.inactive_bonds.end(), std::size_t{0})),
                            static_cast<double>(std::accumulate(model.result.detached.begin(),
                                                                model.result.detached.end(), std::size_t{0}))};
    for (std::size_t o = 0; o < model.state.obstacles.size(); ++o)
        for (Eigen::Index c = 0; c < 3; ++c) {
            row.push_back(-dynamics.contact().reactions_of_obstacles()[o][c]);
            row.push_back(model.state.obstacles[o].shift[c]);
        }
    return row;
}

} // namespace periporo
