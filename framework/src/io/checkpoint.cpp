// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
#include "io/checkpoint.hpp"

#include "io/archive.hpp"
#include "operator/refresh.hpp"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <span>
#include <stdexcept>
#include <utility>

namespace periporo {
namespace {

/// To be counted up whenever a checkpoint needs something that it did not hold before.
constexpr const char* format = "periporo checkpoint 8";

std::span<const double> flat(const std::vector<Vector3>& vectors)
{
    static_assert(sizeof(Vector3) == 3 * sizeof(double));
    return {vectors.empty() ? nullptr : vectors.front().data(), 3 * vectors.size()};
}

std::vector<Vector3> vectors(const std::vector<double>& values)
{
    std::vector<Vector3> result(values.size() / 3);
    for (std::size_t i = 0; i < result.size(); ++i)
        result[i] = {values[3 * i], values[3 * i + 1], values[3 * i + 2]};
    return result;
}

std::vector<double> isometry_values(const IsometryTable& table)
{
    std::vector<double> values;
    for (std::uint32_t n = 0; n < table.size(); ++n) {
        values.insert(values.end(), table[n].rotation.data(), table[n].rotation.data() + 9);
        values.insert(values.end(), table[n].translation.data(), table[n].translation.data() + 3);
    }
    return values;
}

std::vector<Isometry> isometries(const std::vector<double>& values)
{
    std::vector<Isometry> result(values.size() / 12);
    for (std::size_t n = 0; n < result.size(); ++n) {
        std::copy_n(values.data() + 12 * n, 9, result[n].rotation.data());
        std::copy_n(values.data() + 12 * n + 9, 3, result[n].translation.data());
    }
    return result;
}

/// Numbers of points and images as bytes: an archive knows no shorter integers.
std::span<const std::uint8_t> as_bytes(const std::vector<std::uint32_t>& numbers)
{
    return {reinterpret_cast<const std::uint8_t*>(numbers.data()), numbers.size() * sizeof(std::uint32_t)};
}

std::vector<std::uint32_t> numbers(const std::vector<std::uint8_t>& bytes)
{
    std::vector<std::uint32_t> result(bytes.size() / sizeof(std::uint32_t));
    std::copy_n(bytes.begin(), result.size() * sizeof(std::uint32_t), reinterpret_cast<std::uint8_t*>(result.data()));
    return result;
}

template <class Value>
std::vector<std::span<Value>> parts_of(auto& vectors)
{
    return {vectors.begin(), vectors.end()};
}

template <class Vector>
void copy_checked(const std::vector<typename Vector::value_type>& from, Vector& to, const char* name)
{
    if (from.size() != to.size())
        throw std::runtime_error(
            fmt::format("the checkpoint holds {} values of {}, this model has {}", from.size(), name, to.size()));
    std::copy(from.begin(), from.end(), to.begin());
}

/// The lists of a course of water, by name.
auto named_parts(auto& water)
{
    return std::array{std::pair{"pressure_before", &water.pressure_before},
                      std::pair{"saturation_before", &water.saturation_before},
                      std::pair{"pressure_after", &water.pressure_after},
                      std::pair{"saturation_after", &water.saturation_after},
                      std::pair{"soaked", &water.soaked},
                      std::pair{"level_before", &water.level_before},
                      std::pair{"level_after", &water.level_after},
                      std::pair{"lowest", &water.lowest},
                      std::pair{"done", &water.done}};
}

} // namespace

void write_checkpoint(const std::filesystem::path& file, const CheckpointParts& parts, const std::string& resolved_case)
{
    const Model& model = parts.model;
    const Points& points = model.points;
    const RunPosition& at = parts.position;
    ArchiveWriter archive(file);
    archive.put("format", format);
    archive.put("case", resolved_case);
    archive.put("position", flat(points.position));
    archive.put("velocity", flat(points.velocity));
    archive.put("force", flat(points.force));
    archive.put("volume", std::span<const double>(points.volume));
    archive.put("jacobian", std::span<const double>(points.jacobian));
    archive.put("refresh_position", flat(model.refresh_position));
    const Families::Kept families = model.families.kept();
    archive.put("family_counts", as_bytes(families.family_counts));
    archive.put("family_neighbours", as_bytes(families.family_neighbours));
    archive.put("apart_counts", as_bytes(families.apart_counts));
    archive.put("apart_neighbours", as_bytes(families.apart_neighbours));
    archive.put("point_state", std::span<const double>(model.point_state));
    archive.put_parts("bond_state", parts_of<const double>(model.bonds.states));
    archive.put("bond_active", std::span<const std::uint8_t>(model.bonds.active));
    archive.put("free_grain", std::span<const std::uint8_t>(model.free_grain));
    archive.put("inactive_bonds", std::span<const std::int64_t>(std::vector<std::int64_t>(model.inactive_bonds.begin(),
                                                                                          model.inactive_bonds.end())));
    const std::vector<double> table = isometry_values(model.isometries);
    archive.put("isometries", std::span<const double>(table));
    archive.put("grain_reach", std::span<const double>(parts.contact.grain_reach()));
    std::vector<Vector3> shifts(model.obstacles.size());
    std::ranges::transform(model.obstacles, shifts.begin(), &Obstacle::shift);
    archive.put("obstacle_shift", flat(shifts));
    archive.put("surface_room", std::span<const double>(parts.contact.rooms()));
    const ContactForces::SurfaceTrack track = parts.contact.surface_track();
    archive.put("surface_free_place", flat(track.free_places));
    archive.put("surface_searched", flat(track.searched));
    archive.put("surface_searched_shift", flat(track.searched_shifts));
    archive.put("deepest_overlap", std::span<const double>(parts.contact.deepest_overlap()));
    archive.put("crossed_points", std::span<const std::int64_t>(parts.contact.crossed_points()));
    archive.put("frequency_mode", flat(parts.frequency.mode()));
    archive.put("mass", std::span<const double>(points.mass));
    archive.put("pore_pressure", std::span<const double>(points.pore_pressure));
    archive.put("saturation", std::span<const double>(points.saturation));
    for (const auto& [name, values] : named_parts(parts.water))
        archive.put(name, std::span<const double>(*values));

    const Dynamics::State& dynamics = parts.dynamics.state();
    archive.put("undamped_force", flat(dynamics.undamped_force));
    archive.put("buoyancy", std::span<const double>(dynamics.buoyancy));
    const EnergyLedger& ledger = dynamics.ledger;
    const std::vector<double> reals{
        at.time,           at.stage_start,       at.time_step,       at.wall_seconds,
        ledger.kinetic,    ledger.gravity,       ledger.stress_work, ledger.contact,
        ledger.friction,   ledger.collision,     ledger.opening,     dynamics.gravity_datum,
        dynamics.residual, dynamics.force_scale, ledger.verlet,      dynamics.force_squared_per_mass,
        ledger.boundary,   ledger.turned_over,   at.error_before};
    archive.put("reals", std::span<const double>(reals));
    std::vector<std::int64_t> integers{static_cast<std::int64_t>(at.stage),
                                       static_cast<std::int64_t>(at.stage_step),
                                       static_cast<std::int64_t>(at.step),
                                       static_cast<std::int64_t>(at.next_history),
                                       at.ledger_open ? 1 : 0,
                                       static_cast<std::int64_t>(dynamics.refreshes)};
    for (const std::uint64_t next : at.next_output)
        integers.push_back(static_cast<std::int64_t>(next));
    archive.put("integers", std::span<const std::int64_t>(integers));
    archive.put("stage_reports", at.stage_reports);
    archive.put("inputs", at.inputs);
    const LedgerPowers& powers = dynamics.powers;
    archive.put("ledger_powers", std::span<const double>(std::vector<double>{
                                     powers.boundary.at_end, powers.boundary.growth, powers.friction.at_end,
                                     powers.friction.growth, powers.collision.at_end, powers.collision.growth}));
    const RestCriterion::State& rest = at.rest;
    archive.put("rest_position", flat(rest.position));
    archive.put("rest_velocity", flat(rest.velocity));
    archive.put("rest", std::span<const double>(std::vector<double>{rest.begun, rest.length, rest.peak, rest.last}));
    archive.commit();
}

void read_checkpoint(const std::filesystem::path& file, const CheckpointParts& parts, const std::string& resolved_case,
                     double contact_slack, const std::function<void(std::uint64_t stage)>& enter_stage)
{
    const ArchiveReader archive(file);
    if (!archive.has("format") || archive.text("format") != format)
        throw ForeignCheckpoint(fmt::format("{} was written by another version of the program; start anew with "
                                            "--overwrite, or go on with the program that wrote it",
                                            file.string()));
    if (archive.text("case") != resolved_case)
        throw ForeignCheckpoint(fmt::format("{} was written by another case or with other --set values; run the case "
                                            "that it was started with, or start anew with --overwrite",
                                            file.string()));
    Model& model = parts.model;
    Points& points = model.points;
    RunPosition& at = parts.position;

    const std::vector<std::int64_t> integers = archive.integers("integers");
    at.stage = static_cast<std::uint64_t>(integers.at(0));
    at.stage_step = static_cast<std::uint64_t>(integers.at(1));
    at.step = static_cast<std::uint64_t>(integers.at(2));
    at.next_history = static_cast<std::uint64_t>(integers.at(3));
    at.ledger_open = integers.at(4) != 0;
    at.next_output.assign(integers.begin() + 6, integers.end());
    at.stage_reports = archive.text("stage_reports");
    const std::vector<double> reals = archive.reals("reals");
    at.time = reals.at(0);
    at.stage_start = reals.at(1);
    at.time_step = reals.at(2);
    at.wall_seconds = reals.at(3);
    at.error_before = reals.at(18);
    const std::vector<double> rest = archive.reals("rest");
    at.rest = {vectors(archive.reals("rest_position")),
               vectors(archive.reals("rest_velocity")),
               rest.at(0),
               rest.at(1),
               rest.at(2),
               rest.at(3)};

    // Families and contact candidates are those of the last refresh; their images are made again from its positions.
    model.isometries.restore(isometries(archive.reals("isometries")));
    enter_stage(at.stage);
    copy_checked(vectors(archive.reals("refresh_position")), points.position, "position");
    copy_checked(archive.reals("volume"), points.volume, "volume");
    copy_checked(archive.reals("jacobian"), points.jacobian, "J");
    copy_checked(archive.reals("mass"), points.mass, "mass");
    copy_checked(archive.reals("pore_pressure"), points.pore_pressure, "pore pressure");
    copy_checked(archive.reals("saturation"), points.saturation, "saturation");
    for (const auto& [name, values] : named_parts(parts.water))
        *values = archive.reals(name);
    const Families::Kept kept{numbers(archive.bytes("family_counts")), numbers(archive.bytes("family_neighbours")),
                              numbers(archive.bytes("apart_counts")), numbers(archive.bytes("apart_neighbours"))};
    find_first_families(model, parts.force_state, &kept);
    const std::vector<Vector3> shifts = vectors(archive.reals("obstacle_shift"));
    for (std::size_t o = 0; o < model.obstacles.size(); ++o)
        model.obstacles[o].shift = shifts.at(o);
    parts.contact.find_candidates(model, contact_slack);
    parts.contact.set_rooms(model, archive.reals("surface_room"));
    parts.contact.set_surface_track(model, {vectors(archive.reals("surface_free_place")),
                                            vectors(archive.reals("surface_searched")),
                                            vectors(archive.reals("surface_searched_shift"))});
    parts.contact.set_deepest_overlap(archive.reals("deepest_overlap"));
    parts.contact.set_crossed_points(archive.integers("crossed_points"));
    archive.read_parts("bond_state", parts_of<double>(model.bonds.states));
    copy_checked(archive.bytes("bond_active"), model.bonds.active, "bond activity");
    copy_checked(archive.reals("point_state"), model.point_state, "point state");
    copy_checked(archive.bytes("free_grain"), model.free_grain, "free grains");
    const std::vector<std::int64_t> inactive = archive.integers("inactive_bonds");
    std::copy(inactive.begin(), inactive.end(), model.inactive_bonds.begin());
    copy_checked(vectors(archive.reals("position")), points.position, "position");
    copy_checked(vectors(archive.reals("velocity")), points.velocity, "velocity");
    copy_checked(vectors(archive.reals("force")), points.force, "force");
    model.update_records();

    parts.contact.set_grain_reach(archive.reals("grain_reach"));
    parts.frequency.set_mode(vectors(archive.reals("frequency_mode")));
    Dynamics::State dynamics;
    dynamics.ledger.kinetic = reals.at(4);
    dynamics.ledger.gravity = reals.at(5);
    dynamics.ledger.stress_work = reals.at(6);
    dynamics.ledger.contact = reals.at(7);
    dynamics.ledger.friction = reals.at(8);
    dynamics.ledger.collision = reals.at(9);
    dynamics.ledger.opening = reals.at(10);
    dynamics.gravity_datum = reals.at(11);
    dynamics.residual = reals.at(12);
    dynamics.force_scale = reals.at(13);
    dynamics.ledger.verlet = reals.at(14);
    dynamics.force_squared_per_mass = reals.at(15);
    dynamics.ledger.boundary = reals.at(16);
    dynamics.ledger.turned_over = reals.at(17);
    const std::vector<double> powers = archive.reals("ledger_powers");
    dynamics.powers = {{powers.at(0), powers.at(1)}, {powers.at(2), powers.at(3)}, {powers.at(4), powers.at(5)}};
    dynamics.refreshes = static_cast<std::uint64_t>(integers.at(5));
    dynamics.undamped_force = vectors(archive.reals("undamped_force"));
    dynamics.buoyancy = archive.reals("buoyancy");
    parts.dynamics.restore(std::move(dynamics));
}

} // namespace periporo
