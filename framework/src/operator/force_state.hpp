// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The periporomechanics operator: from positions and velocities to bond stresses and internal forces.
#pragma once

#include "model/model.hpp"
#include "operator/evaluation.hpp"
#include "operator/influence.hpp"
#include "plugins/built_in.hpp"

#include <memory>
#include <span>
#include <string>
#include <vector>

namespace periporo {

/// A sub-horizon thinner than this carries no stress: with K_b the shape tensor, omega_i the mean influence in the
/// family and V(H_b) the volume, the squared thickness is 1/(tr(K_b^-1) omega_i V(H_b)), here over the second moment of
/// the influence function. It is 1/3 for a full family, 0 for a sheet, a row or fewer than four points, and above
/// the bound in an intact lattice with any influence function, corners included. The frequency of a bond grows with the
/// inverse of its thickness, so this bound also keeps the stable step: of a column in collapse some 4 per cent of the
/// bonds of the thin rim are inactive; a bound on det K/(tr K/3)^3 of 1e-3 alone leaves them in and cuts the step of
/// the whole run to a fifteenth.
inline constexpr double least_relative_thickness = 0.1;

/// A shape tensor K_b or K_i with det K/(tr K/3)^3 below this counts as singular. Of a pair or a row both the
/// determinant and the adjugate are round-off, so that the thickness alone is a comparison of two accidents: two loose
/// grains within each other's horizon once took such a bond for sound and left at 75 km/s.
inline constexpr double singular_shape_quality = 1e-3;

/// A point whose K_i of the bond projection has det K/(tr K/3)^3 below this has no gradient of its own.
inline constexpr double least_shape_quality = 0.15;

/// In spacings. The stiffness along a bond whose gradient maps the bond itself grows with 1/|zeta|^2, and the direction
/// of two points on top of each other means nothing: below this length `bond_projection` has no bond that carries
/// stress, and `energy_conjugate` asks for (|zeta|/l)^2 of the agreement, l being this length.
inline constexpr double shortest_bond = 0.35;

/// Where stresses live. Refresh, hand-over, initial stress, fields and checkpoints follow it by way of BondStates.
enum class StressSite {
    bonds, ///< (i,j) and (j,i) have a stress each
    pairs  ///< (i,j) and (j,i) have one; where the states of their points differ, it starts from the mean
};

/// How bond stresses become forces. One object serves all points; it holds no state of the simulation.
class ForceState {
public:
    explicit ForceState(Influence influence) : influence_(influence) {}
    virtual ~ForceState() = default;

    const Influence& influence() const { return influence_; }

    /// Advances the states on bonds and finds forces, for the positions and velocities at the ends of the bonds:
    /// velocities are those of the middle of the step, positions those of its end.
    /// @param bonds of the state; changed by StressUpdate::advance alone
    /// @param result overwritten, but for its times, to which those of this evaluation are added
    /// @throws MaterialFailure naming the first point, in the order of points, whose material failed
    virtual void evaluate(const OperatorInput& input, const Evaluation& evaluation, BondStates& bonds,
                          OperatorWorkspace& workspace, OperatorResult& result) const = 0;

    /// The same with all parts of a model.
    void evaluate(Model& model, const Evaluation& evaluation) const
    {
        evaluate({model.state, model.neighbourhood, model.ends}, evaluation, model.bonds, model.workspace,
                 model.result);
    }

    /// Weights of a point's bonds in its mean state: non-negative, 0 for inactive bonds, sum 1 unless all are
    /// inactive. `weights` has pack_width values a pack of the family. The ends of bonds and the result must be
    /// current.
    virtual void bond_weights(const Model& model, std::size_t point, std::span<double> weights) const = 0;

    /// Does it sum over sub-horizons?
    virtual bool uses_sub_horizons() const { return false; }

    virtual StressSite stress_site() const { return StressSite::bonds; }

private:
    Influence influence_;
};

/// @throws std::invalid_argument for a name that is not in force_state_names().
std::unique_ptr<ForceState> make_force_state(const std::string& name, Influence influence);

} // namespace periporo
