// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// How large a case is, before anything of that size is made.
#pragma once

#include "assembly/geometries.hpp"
#include "case/description.hpp"
#include "plugins/registry.hpp"

#include <string>
#include <vector>

namespace periporo {

struct SizeEstimate {
    std::vector<double> points_of_bodies;
    double points = 0.0;           ///< volume over the cube of the spacing, on the kept side of symmetry planes
    double bonds_of_a_point = 0.0; ///< within the horizon, inside a cubic lattice
    double bytes = 0.0;            ///< that the model keeps; see bytes_of_a_point()
    double peak_bytes = 0.0;       ///< while families are found anew
};

/// Memory of a point by Model::memory(), for N bonds and a material with s state variables:
///
///     p + N (12 + 8 (6 + s) h) + N (8 + 0.76 N^(2/3) w)
///
/// with p = 1300 and h = 1/2 for bond_projection, whose points keep moments and where two points hold a bond together,
/// p = 600 and h = 1 elsewhere. The last term is that of the force states with sub-horizons: a bond shares all but
/// about 0.38 N^(2/3) members with the one before it, which are written as two bytes, or four (w = 2) when a family has
/// more than 255 members. The constants are those of blocks of 8,000 points with 29 to 204 bonds each.
double bytes_of_a_point(const std::string& force_state, double bonds, std::size_t state_variables);

/// @throws CaseError with every geometry that cannot be made
SizeEstimate estimate_size(const CaseDescription& description, const PluginRegistry& registry, Geometries& geometries);

/// Memory that this process may still take: what the machine has available, the limit of its control group and that of
/// the process count [bytes].
double available_memory();

/// @throws CaseError with the numbers and what to change when the case has more points, bonds or bytes than fit.
void check_size(const CaseDescription& description, const PluginRegistry& registry, Geometries& geometries);

/// "1.2 GB"
std::string memory_text(double bytes);

} // namespace periporo
