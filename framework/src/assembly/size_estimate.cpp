// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
#include "assembly/size_estimate.hpp"

#include "assembly/build_model.hpp"
#include "case/refusal.hpp"
#include "neighbourhood/families.hpp"

#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fstream>
#include <limits>
#include <numbers>
#include <sstream>

namespace periporo {
namespace {

constexpr double most_points = 2e9; ///< points and their images are counted in 32 bits
/// Old and new families at once: blocks of 15,600 points take 1.4 (energy_conjugate) to 1.7 times (bond_projection)
/// what Model::memory tells.
constexpr double peak_over_kept = 1.7;
constexpr double longest_body = 1e7; ///< along an axis [spacings]
constexpr double part_to_use = 0.95; ///< of the memory that is available

/// Points of a cubic lattice within a radius in spacings, without the one in the middle.
double lattice_neighbours(double radius)
{
    constexpr double counted = 20.0;
    if (radius > counted)
        return 4.0 / 3.0 * std::numbers::pi * radius * radius * radius;
    const int reach = static_cast<int>(radius);
    double count = -1.0;
    for (int x = -reach; x <= reach; ++x)
        for (int y = -reach; y <= reach; ++y)
            for (int z = -reach; z <= reach; ++z)
                count += x * x + y * y + z * z <= radius * radius ? 1.0 : 0.0;
    return count;
}

/// Part of a box on the side that boundaries keep.
double kept_part(const CaseDescription& description, const Bounds& bounds)
{
    double part = 1.0;
    for (const BoundaryDescription& boundary : description.boundaries) {
        const int axis = boundary.plane.axis;
        const double extent = bounds.upper[axis] - bounds.lower[axis];
        const double begin = std::max(bounds.lower[axis], boundary.plane.offset);
        const double end = boundary.kind == ImageKind::periodic
                               ? std::min(bounds.upper[axis], boundary.plane.offset + boundary.period)
                               : bounds.upper[axis];
        if (extent > 0.0)
            part *= std::clamp((end - begin) / extent, 0.0, 1.0);
    }
    return part;
}

double first_number(const std::filesystem::path& file, const std::string& key)
{
    std::ifstream stream(file);
    for (std::string line; std::getline(stream, line);)
        if (line.starts_with(key)) {
            std::istringstream words(line.substr(key.size()));
            double value = 0.0;
            if (words >> value)
                return value;
        }
    return std::numeric_limits<double>::infinity();
}

/// What the control group of the process leaves (version 2); infinity when it has no limit.
double left_by_group()
{
    std::ifstream groups("/proc/self/cgroup");
    std::string group;
    for (std::string line; std::getline(groups, line);)
        if (line.starts_with("0::"))
            group = line.substr(3);
    double left = std::numeric_limits<double>::infinity();
    for (const std::string& folder : {"/sys/fs/cgroup" + group + "/", std::string("/sys/fs/cgroup/")}) {
        const double limit = first_number(folder + "memory.max", "");
        const double cache = first_number(folder + "memory.stat", "inactive_file ");
        const double used = first_number(folder + "memory.current", "") - (std::isfinite(cache) ? cache : 0.0);
        if (std::isfinite(limit) && std::isfinite(used))
            left = std::min(left, limit - used);
    }
    return left;
}

/// Refuses a geometry so long that counting its volume would not end in reasonable time. @throws std::runtime_error
void require_sensible_extent(const Bounds& bounds, double spacing)
{
    const double longest = (bounds.upper - bounds.lower).maxCoeff();
    if (longest > longest_body * spacing)
        throw std::runtime_error(
            fmt::format("the box around it is {:.4g} m long, {:.3g} spacings; is the spacing, or a "
                        "unit of the geometry, wrong?",
                        longest, longest / spacing));
}

} // namespace

double bytes_of_a_point(const std::string& force_state, double bonds, std::size_t state_variables)
{
    const double share = force_state == "bond_projection" ? 0.5 : 1.0;
    const double rows = 6.0 + static_cast<double>(state_variables);
    const double of_point = force_state == "bond_projection" ? 1300.0 : 600.0;
    const double kept = of_point + bonds * (12.0 + 8.0 * rows * share);
    if (force_state == "bond_projection" || force_state == "unstabilized")
        return kept;
    return kept + bonds * (8.0 + 0.76 * std::pow(bonds, 2.0 / 3.0) * (bonds > 255.0 ? 2.0 : 1.0));
}

SizeEstimate estimate_size(const CaseDescription& description, const PluginRegistry& registry, Geometries& geometries)
{
    SizeEstimate size;
    const double cell = std::pow(description.discretization.spacing, 3);
    size.bonds_of_a_point = lattice_neighbours(description.discretization.horizon_ratio);
    Refusals refusals(description);
    for (std::size_t b = 0; b < description.bodies.size(); ++b) {
        const BodyDescription& body = description.bodies[b];
        refusals.attempt("body." + body.name + ".geometry", [&] {
            const std::shared_ptr<const Geometry> geometry = geometries.of_body(b);
            require_sensible_extent(geometry->bounds(), description.discretization.spacing);
            const double points = geometry->volume() / cell * kept_part(description, geometry->bounds());
            size.points_of_bodies.push_back(points);
            size.points += points;
            size.bytes +=
                points * bytes_of_a_point(description.operators.force_state, size.bonds_of_a_point,
                                          make_material(description, body, registry)->state_variables().size());
        });
    }
    refusals.raise();
    size.peak_bytes = peak_over_kept * size.bytes;
    return size;
}

double available_memory()
{
    double available = std::min(1024.0 * first_number("/proc/meminfo", "MemAvailable:"), left_by_group());
    rlimit limit{};
    if (getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY)
        available = std::min(available, static_cast<double>(limit.rlim_cur) -
                                            1024.0 * first_number("/proc/self/status", "VmSize:"));
    return available;
}

void check_size(const CaseDescription& description, const PluginRegistry& registry, Geometries& geometries)
{
    const SizeEstimate size = estimate_size(description, registry, geometries);
    if (size.bonds_of_a_point > largest_family)
        throw refusal(description, "discretization.horizon",
                      fmt::format("a horizon of {:.6g} spacings gives a point {:.4g} bonds, more than {}",
                                  description.discretization.horizon_ratio, size.bonds_of_a_point, largest_family),
                      "--set discretization.horizon=3.015");
    const double available = available_memory();
    const bool fits = size.points <= most_points && size.peak_bytes <= part_to_use * available;
    if (fits)
        return;
    const double too_much = std::max(size.points / most_points, size.peak_bytes / (part_to_use * available));
    const double spacing = description.discretization.spacing * std::cbrt(too_much);
    throw refusal(
        description, "discretization.spacing",
        fmt::format("about {:.3g} points with {:.0f} bonds each take {} and up to {} while families are found "
                    "anew; {} are available",
                    size.points, size.bonds_of_a_point, memory_text(size.bytes), memory_text(size.peak_bytes),
                    memory_text(available)),
        fmt::format("a spacing of {:.2g} m or more fits: --set discretization.spacing={:.2g}", 1.05 * spacing,
                    1.05 * spacing));
}

std::string memory_text(double bytes)
{
    return bytes < 1e9 ? fmt::format("{:.3g} MB", 1e-6 * bytes) : fmt::format("{:.4g} GB", 1e-9 * bytes);
}

} // namespace periporo
