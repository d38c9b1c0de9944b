// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Write a material law once, for one point, and run it on packs.
//
//     struct MyLaw {
//         static constexpr std::size_t state_count = 1;
//         static std::vector<Parameter> parameters();
//         static std::vector<StateVariable> state_variables();            // state_count of them
//         explicit MyLaw(const Parameters& parameters);
//         double bulk_modulus() const;
//         double shear_modulus() const;
//         template <class Real> LawResult<Real, 1> update(const LawInput<Real, 1>& old) const;
//         template <class Real> std::array<Real, 1> initial_state(const LawInput<Real, 1>& settled,
//                                                                 double overconsolidation_ratio) const;
//     };
//     PERIPORO_PLUGIN(periporo::PluginKind::material, periporo::LawMaterial<MyLaw>, "my_law", "What it is")
//
// `Real` is double or Pack; branches on values are written with select() and any() of pack.hpp.
#pragma once

#include "periporo/material.hpp"
#include "periporo/tensor.hpp"

#include <array>
#include <bit>

namespace periporo {

/// What a law is given: the old state of one point (or of one pack of points) and the strain increment.
template <class Real, std::size_t state_count>
struct LawInput {
    SymmetricTensor<Real> stress;           ///< effective, tension-positive, already rotated with the material [Pa]
    SymmetricTensor<Real> strain_increment; ///< D dt, extension-positive [-]
    std::array<Real, state_count> state;    ///< in the order of state_variables()
    Real suction{0.0};                      ///< s >= 0 [Pa]
    Real saturation{0.0};                   ///< S_r [-]
    double time_step = 0.0;                 ///< [s]
};

/// What a law returns: the new state, and in which lanes the update did not converge.
template <class Real, std::size_t state_count>
struct LawResult {
    SymmetricTensor<Real> stress;
    std::array<Real, state_count> state;
    Mask<Real> failed{false};
    const char* reason = nullptr; ///< static text, when any lane failed
};

/// Isotropic Hooke's law: stress + K tr(d) 1 + 2 G dev(d).
template <class Real>
SymmetricTensor<Real> elastic_stress(const SymmetricTensor<Real>& stress, const SymmetricTensor<Real>& strain_increment,
                                     double bulk_modulus, double shear_modulus)
{
    return stress + strain_increment * Real(2.0 * shear_modulus) +
           SymmetricTensor<Real>::isotropic(trace(strain_increment) * (bulk_modulus - 2.0 / 3.0 * shear_modulus));
}

/// Turns a law into the batch interface the operator calls: one virtual call for a block of bonds.
template <class Law>
class LawMaterial : public Material {
public:
    static constexpr std::size_t state_count = Law::state_count;
    static constexpr std::size_t rows = 6 + state_count;

    static std::vector<Parameter> parameters() { return Law::parameters(); }

    explicit LawMaterial(const Parameters& parameters) : law_(parameters), variables_(Law::state_variables()) {}

    const Law& law() const { return law_; }
    const std::vector<StateVariable>& state_variables() const override { return variables_; }
    double bulk_modulus() const override { return law_.bulk_modulus(); }
    double shear_modulus() const override { return law_.shear_modulus(); }

    MaterialStatus update(const MaterialBatch& batch) const override
    {
        for (std::size_t p = 0; p < batch.packs; ++p) {
            if (batch.active[p] == 0)
                continue;
            LawInput<Pack, state_count> input = load(batch, p);
            input.strain_increment = load_tensor(batch.strain_increment + p * 6 * pack_width);
            input.time_step = batch.time_step;
            double* bond = batch.bonds + p * rows * pack_width;
            if (batch.response == MaterialResponse::elastic) {
                store_tensor(elastic_stress(input.stress, input.strain_increment, bulk_modulus(), shear_modulus()),
                             bond);
                continue;
            }
            const LawResult<Pack, state_count> result = law_.update(input);
            store_tensor(result.stress, bond);
            for (std::size_t s = 0; s < state_count; ++s)
                result.state[s].copy_to(bond + (6 + s) * pack_width, std::experimental::vector_aligned);
            if (any(result.failed))
                for (std::size_t lane = 0; lane < pack_width; ++lane)
                    if (result.failed[lane] && (batch.active[p] >> lane & 1u) != 0)
                        return {false, p * pack_width + lane, result.reason};
        }
        return {};
    }

    void initialize(const MaterialBatch& batch, double overconsolidation_ratio) const override
    {
        for (std::size_t p = 0; p < batch.packs; ++p) {
            const std::array<Pack, state_count> state = law_.initial_state(load(batch, p), overconsolidation_ratio);
            for (std::size_t s = 0; s < state_count; ++s)
                state[s].copy_to(batch.bonds + (p * rows + 6 + s) * pack_width, std::experimental::vector_aligned);
        }
    }

private:
    static Pack load_row(const double* row) { return Pack(row, std::experimental::vector_aligned); }

    static SymmetricTensor<Pack> load_tensor(const double* rows_of_pack)
    {
        const auto row = [&](std::size_t c) { return load_row(rows_of_pack + c * pack_width); };
        return {row(0), row(1), row(2), row(3), row(4), row(5)};
    }

    static void store_tensor(const SymmetricTensor<Pack>& tensor, double* rows_of_pack)
    {
        std::size_t c = 0;
        for (const Pack* component : {&tensor.xx, &tensor.yy, &tensor.zz, &tensor.xy, &tensor.yz, &tensor.xz})
            component->copy_to(rows_of_pack + pack_width * c++, std::experimental::vector_aligned);
    }

    LawInput<Pack, state_count> load(const MaterialBatch& batch, std::size_t p) const
    {
        LawInput<Pack, state_count> input;
        const double* bond = batch.bonds + p * rows * pack_width;
        input.stress = load_tensor(bond);
        for (std::size_t s = 0; s < state_count; ++s)
            input.state[s] = load_row(bond + (6 + s) * pack_width);
        input.suction = load_row(batch.suction + p * pack_width);
        input.saturation = load_row(batch.saturation + p * pack_width);
        return input;
    }

    Law law_;
    std::vector<StateVariable> variables_;
};

} // namespace periporo
