// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The stable time step of the explicit integration.
#pragma once

#include "contact/contact_forces.hpp"
#include "model/model.hpp"
#include "operator/force_state.hpp"

#include <span>
#include <vector>

namespace periporo {

/// What bounds the step, and the step taken.
struct StableStep {
    double frequency = 0.0;    ///< estimate of the largest angular frequency of operator and contact together [rad/s]
    double damping_rate = 0.0; ///< of the dashpots of contacts in that mode [1/s]
    double wave_limit = 0.0;   ///< 1.5 dx/c_p [s]
    double sharpest = 0.0;     ///< largest angular frequency of one contact alone [1/s]
    double limit = 0.0;        ///< beyond it the integration is unstable [s]
    double step = 0.0;         ///< [s]
};

/// What the step times the angular frequency of one contact may be at most [-]. Where dashpots act the step resolves
/// the collision, with pi/0.3 = 10 steps for an undamped one, so that the restitution is the one asked for within 0.02
/// at any phase of the first touch. Where a body settles, a contact that begins must not make the step too long: by
/// Weyl's inequality it adds at most 0.8^2 to (omega dt)^2, and a safety of 0.85 leaves 4 (1 - 0.85^2) = 1.1.
double contact_resolution(bool damped);

/// Largest eigenfrequency of the elastic tangent of the operator, families and images as they are: the highest Ritz
/// value of a Krylov space (Arnoldi 1951; for the symmetric tangents the Lanczos process with full orthogonalisation,
/// and it serves the unsymmetric `volume_weighted` as well). Ritz values of symmetric tangents come from below. The
/// space starts from the highest mode found last plus a scattered vector of the same length: the highest mode sits on a
/// few points of the rim, and when another place takes over, the old mode alone does not see it (a column of 9,600
/// points blew up that way). The space grows until the residual of the Ritz vector says that its value is known, so
/// that a body which has hardly changed takes four or five evaluations and a rim that has takes up to twenty. Held
/// directions are left free: they can only lower the highest frequency (Cauchy interlacing).
class FrequencyEstimate {
public:
    /// |K u - omega^2 u| of a Ritz vector of length 1 at which the search ends, over omega^2. While the old mode does
    /// not satisfy it, a new one has time to show: of 172 renewals in a collapsing column
    /// (`cases/column_collapse/quickstart.toml`) the worst comes out 1.2 per cent short in omega with 0.005, 2.2 with
    /// 0.007 and 6.6 with 0.01, after 6.2, 5.7 and 5.2 evaluations on the mean. Eight each time leave 2.8 to 6.2.
    static constexpr double residual = 0.005;
    static constexpr int most_evaluations = 40;

    /// Angular frequency [rad/s]. Nothing of the model changes but its workspace.
    /// @param grounded stiffness of each point against the ground, over its mass, that is added to the operator [1/s2];
    /// empty: none
    double update(Model& model, const ForceState& force_state, std::span<const Eigen::Matrix3d> grounded = {});

    const std::vector<Vector3>& mode() const { return mode_; }
    template <class Self, class Visit>
    static void members(Self& self, Visit& visit, std::size_t points)
    {
        visit("mode", empty_or(self.mode_, points));
    }
    /// Of the operator, that the last update took.
    int evaluations() const { return evaluations_; }

private:
    using Vectors = std::vector<Vector3>;
    /// Sets M^-1 K u of the elastic tangent and of what holds the points to the ground.
    void apply_tangent(Model& model, const ForceState& force_state, std::span<const Eigen::Matrix3d> grounded,
                       const Vectors& displacement, Vectors& acceleration);
    /// Last mode and scattered vector, as the first of the basis.
    void begin_basis(const Points& points);
    Vectors& basis(Eigen::Index number) { return basis_[static_cast<std::size_t>(number)]; }

    Vectors mode_;
    int evaluations_ = 0;
    // their memory is kept from one time to the next, that of as many vectors as the last search took
    std::vector<Vectors> basis_;
    BondEnds displaced_; ///< with displacements as velocities
    OperatorResult result_;
};

/// step = min(safety * limit, 1.5 dx/c_p, resolution/omega of the sharpest contact alone). c_p = sqrt((K + 4G/3)/rho)
/// is that of the fastest body; contacts count at full overlap, those about to begin too. Limit: with dashpots a step
/// dt is stable when no eigenvalue of dt^2 K + 2 dt C is above 4 (see damped_limit()). The highest mode of K + 2 C/dt
/// is sought at the last step dt, with what contact adds as bounds of each point, and the limit is that of an
/// oscillator with the stiffness and damping of this mode. The dashpots of dashpot_in_steps() are weaker than that.
/// @param last_step 0 at the beginning [s]
/// @param damped whether the dashpots of contacts act
/// @param resolution contact_resolution(), largest product of the step and the angular frequency of a contact [-]
StableStep stable_step(Model& model, const ForceState& force_state, ContactForces& contact, FrequencyEstimate& estimate,
                       double safety, double last_step, bool damped, double resolution);

/// The longest step of u" + c u' + omega^2 u = 0 in leapfrog steps whose damping force takes the last mid-step
/// velocity: omega^2 dt^2 + 2 c dt = 4, from the root -1 of z^2 - (2 - omega^2 dt^2 - c dt) z + 1 - c dt. 2/omega
/// without damping.
/// @param frequency_squared omega^2 > 0 [1/s2]
/// @param damping_rate c [1/s]
double damped_limit(double frequency_squared, double damping_rate);

/// What local damping leaves of the stable step, (1 + alpha)^(-1/2): where a force grows against the velocity it
/// multiplies the force by 1 + alpha, and so the stiffness.
double local_damping_factor(double coefficient);

} // namespace periporo
