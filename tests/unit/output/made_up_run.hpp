// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// A run whose fields and history are functions of the step alone, so that any part of it can be written again.
#pragma once

#include "periporo/output.hpp"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace periporo::test {

inline constexpr std::size_t made_up_points = 37;
inline constexpr std::uint64_t steps_between_snapshots = 10;

/// Numbers that use all their digits and signs: a multiplicative hash over +-1, exact, so that every compilation of it
/// gives the same bits.
inline double made_up_value(std::uint64_t step, std::size_t index)
{
    std::uint64_t hash = (step * 1000003 + index + 1) * 0x9e3779b97f4a7c15; // 2^64 over the golden ratio
    hash ^= hash >> 29;
    hash *= 0xbf58476d1ce4e5b9;
    return static_cast<double>(static_cast<std::int64_t>(hash) >> 11) * 0x1p-52;
}

inline std::vector<double> made_up_values(std::uint64_t step, std::size_t count, std::size_t seed)
{
    std::vector<double> values(count);
    for (std::size_t i = 0; i < count; ++i)
        values[i] = made_up_value(step, seed + i);
    return values;
}

inline double made_up_time(std::uint64_t step)
{
    return (static_cast<double>(step) - 7.0) / 10.0;
}

inline RunDescription made_up_run(const std::filesystem::path& directory)
{
    RunDescription run;
    run.directory = directory;
    run.title = "A made-up run, \xcf\x83 < 0";
    run.resolved_case = "title = \"made up\"\n[discretization]\nspacing = \"5 mm\"\n";
    run.provenance = {{"version", "0.1.0"}, {"compiler", "gcc 12"}, {"plugin geometry/box", "sha256 0123"}};
    run.history = {{"time", "s", "Time since the first dynamic stage"},
                   {"kinetic_energy", "J", "Kinetic energy of all points"},
                   {"free_grains", "-", "Points that left their family"}};
    return run;
}

inline RunDescription resumed_run(const std::filesystem::path& directory, std::uint64_t last_step)
{
    RunDescription run = made_up_run(directory);
    run.resumed = true;
    run.resumed_step = last_step;
    return run;
}

inline std::vector<double> made_up_row(std::uint64_t step)
{
    return {made_up_time(step), made_up_value(step, 0), static_cast<double>(step % 7)};
}

/// Shows the writer the snapshot of a step.
inline void give_snapshot(OutputWriter& writer, std::uint64_t step, std::size_t points = made_up_points)
{
    const std::vector<double> positions = made_up_values(step, 3 * points, 100);
    const std::vector<double> velocity = made_up_values(step, 3 * points, 200);
    const std::vector<double> strain = made_up_values(step, points, 300);
    const std::vector<double> stress = made_up_values(step, 6 * points, 400);
    std::vector<std::int64_t> family(points);
    for (std::size_t i = 0; i < points; ++i)
        family[i] = static_cast<std::int64_t>(step * 1000 + i) - 5;
    Snapshot snapshot;
    snapshot.step = step;
    snapshot.time = made_up_time(step);
    snapshot.stage = step < 20 ? "geostatic" : "collapse";
    snapshot.positions = positions;
    snapshot.fields = {{"velocity", "m/s", "Velocity of the point, x y z", 3, velocity, {}},
                       {"plastic_shear_strain", "-", "Equivalent plastic shear strain", 1, strain, {}},
                       {"effective_stress", "Pa", "Tension-positive; xx yy zz xy yz xz", 6, stress, {}},
                       {"family_size", "-", "Points within the horizon", 1, {}, family}};
    writer.snapshot(snapshot);
}

/// Steps `first` to `last`: a row of the history each, a snapshot every tenth.
inline void give_steps(OutputWriter& writer, std::uint64_t first, std::uint64_t last)
{
    for (std::uint64_t step = first; step <= last; ++step) {
        writer.history(step, made_up_row(step));
        if (step % steps_between_snapshots == 0)
            give_snapshot(writer, step);
    }
}

/// The whole run, never interrupted.
inline void write_whole_run(OutputWriter& writer, const std::filesystem::path& directory, std::uint64_t last_step)
{
    writer.begin(made_up_run(directory));
    give_steps(writer, 0, last_step);
    writer.finish(true);
    writer.clean_up();
}

} // namespace periporo::test
