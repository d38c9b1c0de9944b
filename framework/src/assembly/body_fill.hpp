// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The material points of a body: a lattice, a lattice shaken, or points that keep even distances without one.
#pragma once

#include "case/description.hpp"
#include "periporo/geometry.hpp"

#include <functional>

namespace periporo {

/// Fills a body with material points about `spacing` [m] apart, the same on every platform and with any number of
/// threads.
///
/// * "lattice": as `align` says, with the volumes that the lattice has.
/// * "jittered": each point of that lattice shifted at random, evenly between -amplitude and amplitude spacings along
///   each coordinate axis. A shift that would leave the body is halved until it does not.
/// * "relaxed": an irregular cloud of even density. From points of the lattice shifted by up to half a spacing, Lloyd's
///   method moves each point to the centroid of its Voronoi cell within the body, again and again: a centroidal
///   Voronoi tessellation (Q. Du, V. Faber, M. Gunzburger, "Centroidal Voronoi tessellations: applications and
///   algorithms", SIAM Review 41 (1999) 637-676, section 5.2). It ends when no point moves by more than a thousandth of
///   the spacing, or after `iterations`. A move that would leave a body that is not convex is halved until it does not.
///
/// The volumes of jittered and relaxed points are those of their Voronoi cells within the body, as far as the samples
/// of BodySamples tell, one sample at least; they add up to the geometry's volume.
/// @param progress called with the part that is done, 0 to 1, while the points are relaxed; may be empty
/// @throws std::runtime_error when the spacing does not fit the geometry, saying what would.
/// @throws std::invalid_argument when the description holds none of the values above.
PointCloud fill_body(const Geometry& geometry, double spacing, const FillDescription& fill,
                     const std::function<void(double)>& progress = {});

} // namespace periporo
