// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// What stops a run that goes wrong: points that are lost, speed and energy from nowhere.
#pragma once

#include "case/description.hpp"
#include "model/model.hpp"
#include "time/dynamics.hpp"

#include <string>

namespace periporo {

/// A point that is so far from where it began is lost: 1000 horizons [m].
double lost_distance(const Model& model);

/// Names a point that is not finite or farther than 1000 horizons from where it began. Each guard returns an empty text
/// when nothing is wrong.
std::string lost_point(const Model& model);

/// A kinetic energy that is more than twice what the accounts of the ledger gave, and the limit of the energy error
/// more: no motion has it.
/// @param error_before of the ledger, that earlier stages with artificial damping left [J]
std::string energy_of_motion_from_nowhere(const Model& model, const CaseDescription& description,
                                          const EnergyLedger& ledger, double error_before);

/// An energy error beyond the limit of the case.
std::string energy_error_beyond_limit(const Model& model, const CaseDescription& description,
                                      const EnergyLedger& ledger, double error_before);

/// While a body settles, damping takes energy that no account holds. A point is then too fast when it moves at more
/// than ten times the largest speed that what drives the bodies gives: a fall over the size of the model with the
/// acceleration of the largest unbalanced force, the motion at the start, of obstacles and of held points.
/// @param acceleration largest of the forces, per mass [m/s2]
std::string faster_than_driven(const Model& model, const CaseDescription& description, double acceleration);

} // namespace periporo
