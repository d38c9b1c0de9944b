// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The periporomechanics operator: from positions and velocities to bond stresses and internal forces.
#pragma once

#include "model/model.hpp"
#include "operator/influence.hpp"

#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

namespace periporo {

/// What an evaluation does with the stress of the bonds.
enum class StressUpdate {
    advance, ///< by the material over one step
    keep,    ///< forces of the stress as it is
    tangent  ///< forces of the stress C : D alone, velocities taken as displacements; state untouched
};

struct Evaluation {
    StressUpdate stress = StressUpdate::advance;
    MaterialResponse response = MaterialResponse::full;
    double time_step = 0.0; ///< [s]

    /// How far behind the positions lie those that velocity gradients refer to [s].
    double gradient_lag() const { return stress == StressUpdate::advance ? 0.5 * time_step : 0.0; }
};

/// A material update that did not converge: where.
class MaterialFailure : public std::runtime_error {
public:
    MaterialFailure(std::size_t point, const std::string& message) : std::runtime_error(message), point_(point) {}
    std::size_t point() const { return point_; }

private:
    std::size_t point_;
};

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

/// How bond stresses become forces. One object serves all points; it holds no state of the simulation.
class ForceState {
public:
    explicit ForceState(Influence influence) : influence_(influence) {}
    virtual ~ForceState() = default;

    const Influence& influence() const { return influence_; }

    /// Reads records, families and bonds; writes bonds and the outcome members of the model. Velocities are those of
    /// the middle of the step, positions those of its end.
    /// @throws MaterialFailure naming the first point, in the order of points, whose material failed.
    virtual void evaluate(Model& model, const Evaluation& evaluation) const = 0;

    /// Shares of a point's bonds in its mean state: non-negative, 0 for inactive bonds, sum 1 unless all are
    /// inactive. `shares` has pack_width values a pack of the family. Records and activity must be current.
    virtual void shares(const Model& model, std::size_t point, std::span<double> shares) const = 0;

    /// Does it sum over sub-horizons?
    virtual bool uses_sub_horizons() const { return false; }

    /// Do (i,j) and (j,i) carry one state? Then what their ends differ in is met half-way.
    virtual bool shares_bonds() const { return false; }

private:
    Influence influence_;
};

/// Names for `make_force_state`: "energy_conjugate", "energy_conjugate_mean", "volume_weighted", "bond_projection",
/// "unstabilized".
const std::vector<std::string>& force_state_names();

/// @throws std::invalid_argument for a name that is not in force_state_names().
std::unique_ptr<ForceState> make_force_state(const std::string& name, Influence influence);

} // namespace periporo
