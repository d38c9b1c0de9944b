// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Internal forces of points from the forces of bonds, and what every force state reports.
#pragma once

#include "model/model.hpp"
#include "operator/transpose.hpp"
#include "periporo/material.hpp"

#include <limits>
#include <vector>

namespace periporo {

/// Sums internal_force_i = V_i sum_j V_j (T_ij - T_ji) bond by bond: V_i V_j T_ij goes to i and, reversed, to j; that
/// of a bond to an image goes, mirrored, to its parent. Forces of a block of points gather at the places of its halo
/// and are handed out afterwards, so that no result depends on the number of threads.
class BondForces {
public:
    /// Before the first block of an evaluation: room, and no forces.
    static void prepare(Model& model)
    {
        model.at_places.resize(model.halos.places() * place_stride);
        std::fill(model.internal_force.begin(), model.internal_force.end(), Vector3::Zero());
    }

    /// Begins a block: its places are empty.
    BondForces(Model& model, std::size_t block)
        : halos_(model.halos), first_point_(model.halos.first_point(block)),
          places_(model.at_places.data() + model.halos.first_place(block) * place_stride)
    {
        std::fill(places_, model.at_places.data() + model.halos.first_place(block + 1) * place_stride, 0.0);
    }

    /// Takes the forces of a pack of bonds, V_i V_j T_ij of the first `bonds` lanes [N], from the neighbours.
    void take_from_neighbours(std::size_t pack, std::size_t bonds, const std::array<Pack, 3>& force)
    {
        take(halos_.place_of_neighbours(pack), bonds, force, [](std::size_t) { return true; });
    }

    /// The same for a pack of bonds that the point holds, without those to images: their parents hold the mirrored
    /// bond.
    void take_from_points(const Model& model, const FamilyView& family, const HeldBonds& held, std::size_t pack,
                          const std::array<Pack, 3>& force)
    {
        const std::size_t first = pack * pack_width;
        take(halos_.place_of_neighbours(family.first_pack) + held.first + first, held.bonds_in(pack), force,
             [&](std::size_t lane) { return held.neighbours[first + lane] < model.size(); });
    }

    /// Gives the sum of the forces of its bonds to a point of the block.
    void give_to(std::size_t point, const std::array<Pack, 3>& force)
    {
        double* at = places_ + (point - first_point_) * place_stride;
        for (std::size_t c = 0; c < 3; ++c)
            at[c] += reduce(force[c]);
    }

    /// After the last block: adds what has gathered to the internal forces of all points, which are zero before unless
    /// something else was put there.
    static void hand_out(Model& model);

private:
    /// Takes the forces of the lanes for which concerns(lane) holds.
    template <class Concerns>
    void take(const std::uint16_t* place, std::size_t bonds, const std::array<Pack, 3>& force, Concerns&& concerns)
    {
        alignas(64) double rows[pack_width * place_stride];
        store_rows_of_lanes(force, rows);
        for (std::size_t lane = 0; lane < bonds; ++lane) {
            if (!concerns(lane))
                continue;
            double* at = places_ + place[lane] * place_stride;
            (load_place(at) - load_place(rows + lane * place_stride)).copy_to(at, std::experimental::vector_aligned);
        }
    }

    static constexpr std::size_t place_stride = 4;
    using Place = std::experimental::simd<double, std::experimental::simd_abi::deduce_t<double, place_stride>>;
    static Place load_place(const double* at) { return Place(at, std::experimental::vector_aligned); }

    const Halos& halos_;
    std::size_t first_point_;
    double* places_;
};

/// Keeps the failure of the first point, whichever thread met it.
class FirstFailure {
public:
    void report(std::size_t point, const MaterialStatus& status)
    {
#pragma omp critical(periporo_material_failure)
        if (point < point_) {
            point_ = point;
            status_ = status;
        }
    }
    /// @throws MaterialFailure when one was reported.
    void raise(const Model& model) const;

private:
    std::size_t point_ = std::numeric_limits<std::size_t>::max();
    MaterialStatus status_;
};

} // namespace periporo
