// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// One point of a material alone, stepped through the very interface that the operator calls.
//
//     MaterialPoint point(material, SymmetricTensor<double>::isotropic(-1e3));    // 1 kPa of pressure
//     point.initialize(1.25);                                                     // OCR
//     point.step(SymmetricTensor<double>{-1e-4, 0.0, 0.0, 0.0, 0.0, 0.0}, 1e-3);  // oedometric
//     MixedStep triaxial{{false, true, true, false, false, false}, {-1e-4, 0.0, 0.0, 0.0, 0.0, 0.0}, 1e-3};
//     point.step(triaxial);                                                       // lateral stresses held
#pragma once

#include "periporo/material.hpp"
#include "periporo/tensor.hpp"

#include <array>
#include <cmath>
#include <vector>

namespace periporo {

/// Mean effective stress p = -tr(sigma')/3, compression positive [Pa].
inline double mean_pressure(const SymmetricTensor<double>& stress)
{
    return -trace(stress) / 3.0;
}

/// Deviator stress q = sqrt(3/2) |dev sigma'| [Pa].
inline double deviator_stress(const SymmetricTensor<double>& stress)
{
    return std::sqrt(1.5) * norm(deviator(stress));
}

/// Equivalent shear strain sqrt(2/3) |dev eps| [-].
inline double equivalent_shear_strain(const SymmetricTensor<double>& strain)
{
    return std::sqrt(2.0 / 3.0) * norm(deviator(strain));
}

/// The x of least length among those that bring `matrix` x nearest to `right`. Pivots below `zero` times the largest
/// count as none.
Eigen::VectorXd shortest_solution(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& right, double zero);

/// A step with each component under control of stress or of strain.
struct MixedStep {
    std::array<bool, 6> stress_controlled{}; ///< xx yy zz xy yz xz
    /// What each component changes by: effective stress [Pa] where stress is controlled, else strain [-].
    std::array<double, 6> increment{};
    double time_step = 0.0; ///< [s]
    /// The largest deviation of a controlled stress that is left [Pa].
    double tolerance = 1e-6;
    /// Is the shear xz a simple one, of planes z = const. that slide along x? Its velocity gradient has 2 D_xz at xz
    /// and nothing at zx: the point turns by the angle of the strain xz. Else shear strains are pure, without spin.
    bool simple_shear = false;
};

/// Values may be copied: a copy goes its own way from there. The material must outlive it.
class MaterialPoint {
public:
    /// A point under an effective stress [Pa], state variables at their initial values.
    explicit MaterialPoint(const Material& material, const SymmetricTensor<double>& stress = {})
        : material_(&material), rows_(6 + material.state_variables().size())
    {
        set_stress(stress);
        for (std::size_t s = 0; s < material.state_variables().size(); ++s)
            rows_[6 + s] = material.state_variables()[s].initial;
    }

    const Material& material() const { return *material_; }
    /// Effective stress, tension-positive [Pa].
    SymmetricTensor<double> stress() const { return tensor(rows_); }
    /// Sum of all strain increments, extension-positive [-].
    SymmetricTensor<double> strain() const { return strain_; }
    /// In the order of Material::state_variables().
    double state(std::size_t variable) const { return rows_.at(6 + variable)[0]; }
    double suction() const { return suction_[0]; }
    double saturation() const { return saturation_[0]; }

    void set_stress(const SymmetricTensor<double>& stress) { store(stress, rows_); }
    void set_state(std::size_t variable, double value) { rows_.at(6 + variable) = value; }
    /// @param suction s >= 0 [Pa]
    /// @param saturation S_r [-]
    void set_water(double suction, double saturation) { suction_ = suction, saturation_ = saturation; }
    /// Sets the state variables from the stress, as after the geostatic stage.
    void initialize(double overconsolidation_ratio)
    {
        release(*material_, batch(rows_, strain_rows_, 0.0), overconsolidation_ratio);
    }

    /// Advances by a strain increment [-] over a time step [s]. A failed step leaves the point as it was.
    /// @param turn of the material during the step, about y from z towards x [rad]
    MaterialStatus step(const SymmetricTensor<double>& strain_increment, double time_step, double turn = 0.0)
    {
        Rows rows = rows_;
        const MaterialStatus status = respond(rows, strain_increment, time_step, turn);
        if (!status.converged)
            return status;
        rows_ = rows;
        strain_ += strain_increment;
        return status;
    }

    /// Advances by a mixed step: Newton's method with a tangent by differences finds the strains of the components
    /// whose stress is controlled. At an edge of a yield surface many strains give one stress: of them the least is
    /// taken. A failed step leaves the point as it was.
    MaterialStatus step(const MixedStep& step)
    {
        Components strain = Components::Zero();
        Components target = column(stress());
        for (int c = 0; c < 6; ++c)
            (step.stress_controlled[static_cast<std::size_t>(c)] ? target : strain)[c] +=
                step.increment[static_cast<std::size_t>(c)];
        const auto residual = [&](const Components& trial, MaterialStatus& status) {
            Rows rows = rows_;
            status = respond(rows, tensor(trial), step.time_step, turn_of(step, trial));
            Components difference = column(tensor(rows)) - target;
            for (int c = 0; c < 6; ++c)
                if (!step.stress_controlled[static_cast<std::size_t>(c)])
                    difference[c] = 0.0;
            return difference;
        };
        MaterialStatus status;
        Components left = residual(strain, status);
        for (int iteration = 0; iteration < most_iterations; ++iteration) {
            if (!status.converged)
                return status;
            if (left.cwiseAbs().maxCoeff() <= step.tolerance)
                return this->step(tensor(strain), step.time_step, turn_of(step, strain));
            const Components move = newton_step(step.stress_controlled, strain, residual, left);
            if (!move.allFinite())
                break;
            double fraction = 1.0; // backtracking: the residual must fall
            Components next;
            do {
                next = residual(strain + fraction * move, status);
                fraction *= 0.5;
            } while (fraction > 1e-6 && !(status.converged && next.norm() < left.norm()));
            strain += 2.0 * fraction * move;
            left = next;
        }
        return {false, 0,
                "no strain was found that gives the wanted stresses; the path may ask for more than the "
                "material bears"};
    }

private:
    using Rows = std::vector<Pack>; // all lanes alike
    using Components = Eigen::Matrix<double, 6, 1>;
    static constexpr int most_iterations = 60;

    static Components column(const SymmetricTensor<double>& a) { return Components(components(a).data()); }
    static SymmetricTensor<double> tensor(const Components& c) { return symmetric_tensor(c); }
    static SymmetricTensor<double> tensor(const Rows& rows)
    {
        return {rows[0][0], rows[1][0], rows[2][0], rows[3][0], rows[4][0], rows[5][0]};
    }
    static void store(const SymmetricTensor<double>& tensor, Rows& rows)
    {
        std::size_t c = 0;
        for (const double component : components(tensor))
            rows[c++] = component;
    }

    MaterialBatch batch(Rows& rows, const Rows& strain, double time_step) const
    {
        static constexpr std::uint8_t first_lane = 1;
        MaterialBatch batch;
        batch.packs = 1;
        batch.bonds = reinterpret_cast<double*>(rows.data()); // a pack is its lanes side by side
        batch.strain_increment = reinterpret_cast<const double*>(strain.data());
        batch.suction = reinterpret_cast<const double*>(&suction_);
        batch.saturation = reinterpret_cast<const double*>(&saturation_);
        batch.active = &first_lane;
        batch.time_step = time_step;
        return batch;
    }

    /// The spin of simple shear, (L_xz - L_zx)/2, equals the rate of the strain xz.
    static double turn_of(const MixedStep& step, const Components& strain)
    {
        return step.simple_shear ? strain[5] : 0.0;
    }

    static void turn_stress(Rows& rows, double angle)
    {
        const double c = std::cos(angle), s = std::sin(angle);
        store(rotated(tensor(rows), Tensor<double>{c, 0.0, s, 0.0, 1.0, 0.0, -s, 0.0, c}), rows);
    }

    /// Half of the turn before the law and half after it: the strain is that of the middle of the step, and the error
    /// is of second order.
    MaterialStatus respond(Rows& rows, const SymmetricTensor<double>& strain_increment, double time_step,
                           double turn) const
    {
        Rows strain(6);
        store(strain_increment, strain);
        if (turn != 0.0)
            turn_stress(rows, 0.5 * turn);
        MaterialStatus status = material_->update(batch(rows, strain, time_step));
        if (turn != 0.0 && status.converged)
            turn_stress(rows, 0.5 * turn);
        if (status.converged && !column(tensor(rows)).allFinite())
            status = {false, 0, "the law gave a stress that is not a finite number and did not say so"};
        return status;
    }

    /// Newton's step for the strains of the controlled stresses: by differences, and where those leave a singular
    /// tangent the shortest of all solutions.
    template <class Residual>
    Components newton_step(const std::array<bool, 6>& stress_controlled, const Components& strain,
                           const Residual& residual, const Components& at_strain) const
    {
        std::vector<int> controlled;
        for (int c = 0; c < 6; ++c)
            if (stress_controlled[static_cast<std::size_t>(c)])
                controlled.push_back(c);
        const auto size = static_cast<Eigen::Index>(controlled.size());
        Eigen::MatrixXd tangent(size, size);
        const double probe = 1e-7 * (1e-3 + strain.cwiseAbs().maxCoeff());
        for (Eigen::Index d = 0; d < size; ++d) {
            Components probed = strain;
            probed[controlled[static_cast<std::size_t>(d)]] += probe;
            MaterialStatus status;
            tangent.col(d) = ((residual(probed, status) - at_strain) / probe)(controlled);
        }
        constexpr double zero = 1e-8; // what differences leave of it
        Components step = Components::Zero();
        step(controlled) = -shortest_solution(tangent, at_strain(controlled), zero);
        return step;
    }

    const Material* material_;
    Rows rows_;
    Rows strain_rows_ = Rows(6);
    Pack suction_ = 0.0;
    Pack saturation_ = 0.0;
    SymmetricTensor<double> strain_;
};

} // namespace periporo
