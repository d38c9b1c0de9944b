// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Write a material law once, for one point, and run it on packs.
//
//     struct MyLaw {
//         static constexpr std::size_t state_count = 1;
//         static constexpr bool closes = false;                           // may be left out: Material::closes()
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
// `Real` is double, Pack or PackPair; branches on values are written with select() and any() of pack.hpp.
#pragma once

#include "periporo/material.hpp"
#include "periporo/tensor.hpp"

#include <array>
#include <stdexcept>
#include <string>
#include <type_traits>

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

    /// @throws std::logic_error when state_variables() of the law lists more or fewer than state_count
    explicit LawMaterial(const Parameters& parameters) : law_(parameters), variables_(Law::state_variables())
    {
        if (variables_.size() != state_count)
            throw std::logic_error("the law's state_count is " + std::to_string(state_count) +
                                   ", but its state_variables() lists " + std::to_string(variables_.size()));
    }

    const Law& law() const { return law_; }
    const std::vector<StateVariable>& state_variables() const override { return variables_; }
    double bulk_modulus() const override { return law_.bulk_modulus(); }
    double shear_modulus() const override { return law_.shear_modulus(); }

    bool closes() const override
    {
        if constexpr (requires { Law::closes; })
            return Law::closes;
        else
            return Material::closes();
    }

    MaterialStatus update(const MaterialBatch& batch) const override
    {
        MaterialStatus status;
        const auto next_active = [&](std::size_t p) {
            while (p < batch.packs && batch.active[p] == 0)
                ++p;
            return p;
        };
        for (std::size_t p = next_active(0); p < batch.packs && status.converged;) {
            const std::size_t q = next_active(p + 1);
            if (q < batch.packs)
                update<PackPair>(batch, p, q - p, status);
            else
                update<Pack>(batch, p, 0, status);
            p = next_active(q + 1);
        }
        return status;
    }

    void initialize(const MaterialBatch& batch, double overconsolidation_ratio) const override
    {
        for (std::size_t p = 0; p < batch.packs; ++p) {
            const std::array<Pack, state_count> state =
                law_.initial_state(load<Pack>(batch, p, 0), overconsolidation_ratio);
            for (std::size_t s = 0; s < state_count; ++s)
                store_row(state[s], batch.bonds + p * rows * pack_width, 6 + s, 0);
        }
    }

private:
    // Rows of one pack or of two; those of the second lie `distance` doubles behind those of the first.
    template <class Real>
    [[gnu::always_inline]] static Real load_row(const double* rows_of_pack, std::size_t row, std::size_t distance)
    {
        const double* at = rows_of_pack + row * pack_width;
        if constexpr (std::is_same_v<Real, PackPair>)
            return {Pack(at, std::experimental::vector_aligned),
                    Pack(at + distance, std::experimental::vector_aligned)};
        else
            return Pack(at, std::experimental::vector_aligned);
    }
    template <class Real>
    [[gnu::always_inline]] static void store_row(const Real& value, double* rows_of_pack, std::size_t row,
                                                 std::size_t distance)
    {
        double* at = rows_of_pack + row * pack_width;
        if constexpr (std::is_same_v<Real, PackPair>) {
            value.first.copy_to(at, std::experimental::vector_aligned);
            value.second.copy_to(at + distance, std::experimental::vector_aligned);
        } else {
            value.copy_to(at, std::experimental::vector_aligned);
        }
    }
    template <class Real>
    [[gnu::always_inline]] static SymmetricTensor<Real> load_tensor(const double* rows_of_pack, std::size_t distance)
    {
        const auto row = [&](std::size_t c) { return load_row<Real>(rows_of_pack, c, distance); };
        return {row(0), row(1), row(2), row(3), row(4), row(5)};
    }
    template <class Real>
    [[gnu::always_inline]] static void store_tensor(const SymmetricTensor<Real>& tensor, double* rows_of_pack,
                                                    std::size_t distance)
    {
        std::size_t c = 0;
        for (const Real* component : {&tensor.xx, &tensor.yy, &tensor.zz, &tensor.xy, &tensor.yz, &tensor.xz})
            store_row(*component, rows_of_pack, c++, distance);
    }

    template <class Real>
    [[gnu::always_inline]] LawInput<Real, state_count> load(const MaterialBatch& batch, std::size_t p,
                                                            std::size_t apart) const
    {
        LawInput<Real, state_count> input;
        const double* bond = batch.bonds + p * rows * pack_width;
        const std::size_t distance = apart * pack_width;
        input.stress = load_tensor<Real>(bond, rows * distance);
        for (std::size_t s = 0; s < state_count; ++s)
            input.state[s] = load_row<Real>(bond, 6 + s, rows * distance);
        input.suction = load_row<Real>(batch.suction + p * pack_width, 0, distance);
        input.saturation = load_row<Real>(batch.saturation + p * pack_width, 0, distance);
        return input;
    }

    /// Pack p, or for PackPair packs p and p + apart.
    template <class Real>
    void update(const MaterialBatch& batch, std::size_t p, std::size_t apart, MaterialStatus& status) const
    {
        LawInput<Real, state_count> input = load<Real>(batch, p, apart);
        input.strain_increment = load_tensor<Real>(batch.strain_increment + p * 6 * pack_width, 6 * apart * pack_width);
        input.time_step = batch.time_step;
        double* bond = batch.bonds + p * rows * pack_width;
        const std::size_t distance = rows * apart * pack_width;
        if (batch.response == MaterialResponse::elastic) {
            store_tensor(elastic_stress(input.stress, input.strain_increment, bulk_modulus(), shear_modulus()), bond,
                         distance);
            return;
        }
        const LawResult<Real, state_count> result = law_.update(input);
        store_tensor(result.stress, bond, distance);
        for (std::size_t s = 0; s < state_count; ++s)
            store_row(result.state[s], bond, 6 + s, distance);
        if (!any(result.failed))
            return;
        const Real failed = select(result.failed, Real(1.0), Real(0.0));
        for (std::size_t n = 0; n < (apart > 0 ? 2 : 1) * pack_width; ++n) {
            const std::size_t pack = n < pack_width ? p : p + apart;
            if (lane_of(failed, n) != 0.0 && (batch.active[pack] >> n % pack_width & 1u) != 0) {
                status = {false, pack * pack_width + n % pack_width, result.reason};
                return;
            }
        }
    }

    Law law_;
    std::vector<StateVariable> variables_;
};

} // namespace periporo
