// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Finding families anew and handing the state of bonds over from the old ones.
#pragma once

#include "model/model.hpp"
#include "operator/force_state.hpp"

namespace periporo {

/// Families of a model that has none yet, with what the force state asks for; all bonds start with zero stress and
/// initial state variables.
void find_first_families(Model& model, const ForceState& force_state);

/// The same with families that a checkpoint kept, for the positions of the last refresh. The ends of bonds have these
/// positions until Model::gather_ends().
/// @throws std::runtime_error when they do not fit the points
void resume_families(Model& model, const ForceState& force_state, const Families::Kept& kept);

/// Families from the current positions, and those until now (FamilyRule). A bond that was active and is still there
/// keeps its state; any other bond (i,j) takes the mean of the point states of i and j, a point state being the
/// weighted mean over the active bonds of the point. A point without active bonds remembers its state variables
/// and has zero stress.
///
/// Variables of the point (StateVariable::of_point) are evened out: the point's value has moved by the mean change of
/// its bonds, and all its bonds go on from it (begin from the mean of both ends where the force state is symmetric; the
/// points' own values do not mix, so nothing diffuses).
/// @param closed pairs of points apart that have closed, sorted
void refresh_families(Model& model, const ForceState& force_state, std::span<const ClosedPair> closed = {});

/// Sets the variables of the points to the mean of their bonds and evens these out: after they were set bond by bond.
void collect_point_variables(Model& model, const ForceState& force_state);

/// States of all points as their bonds have them now, laid out like PointStates::values, which `states` must start
/// from: a detached point keeps its state variables there.
void mean_point_states(const Model& model, const ForceState& force_state, std::vector<double>& states);

/// The largest displacement of a point since the last refresh relative to the mean displacement of all [m]. Bonds have
/// changed by at most twice as much.
double displacement_since_refresh(const Model& model);

} // namespace periporo
