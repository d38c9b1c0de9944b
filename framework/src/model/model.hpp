// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The state of a simulation: bodies, points, families, and what bonds carry.
#pragma once

#include "families/families.hpp"
#include "families/halos.hpp"
#include "families/sub_horizons.hpp"
#include "model/aligned.hpp"
#include "model/images.hpp"
#include "model/obstacle.hpp"
#include "model/points.hpp"
#include "periporo/material.hpp"

#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace periporo {

struct Body {
    std::string name;
    std::shared_ptr<const Material> material;
    double overconsolidation_ratio = 1.0; ///< OCR, for the initial state of the material [-]
    double porosity = 0.0;                ///< phi0 [-]
    bool ground = false;                  ///< do points of another body stand on its smoothed surface?
    /// Pieces of the body that come nearer than this are one at once; 0 where a contact law holds pieces apart
    /// [spacings].
    double joining_distance = 1.0;
    /// Height along -gravity of the surface of the water that stands around it; minus infinity: none does [m].
    double water_level = -std::numeric_limits<double>::infinity();

    bool has_standing_water() const { return water_level > -std::numeric_limits<double>::infinity(); }
    /// Rows of a bond: six of stress, then the state variables.
    std::size_t rows() const { return 6 + material->state_variables().size(); }
};

/// What the operator gathers about a neighbour, on one cache line.
struct alignas(64) NeighbourRecord {
    double position[3];
    double volume;
    double velocity[3];
    double unused;

    Vector3 x() const { return {position[0], position[1], position[2]}; }
    Vector3 v() const { return {velocity[0], velocity[1], velocity[2]}; }
};

/// Which bonds carry stress: for each pack of a family one bit a bond.
struct ActiveBonds : std::vector<std::uint8_t> {
    /// Does bond b of a family carry stress?
    bool holds(const FamilyView& family, std::size_t b) const
    {
        return ((*this)[family.first_pack + b / pack_width] >> b % pack_width & 1u) != 0;
    }
};

/// What bonds carry from step to step: stress and internal variables.
struct BondData {
    /// For each block of points their states, for each point the packs of the bonds that it holds, for each pack `rows`
    /// rows of pack_width: effective stress, then state variables. A refresh renews them block by block.
    std::vector<UnsetVector<double>> states;
    std::vector<std::uint32_t> first; ///< of a point, in the states of its block
    ActiveBonds active;

    /// Lengths are those that the families ask for.
    template <class Self, class Visit>
    static void members(Self& self, Visit& visit)
    {
        for (std::size_t block = 0; block < self.states.size(); ++block)
            visit("states/" + std::to_string(block), any_reals(self.states[block]));
        visit("active", self.active);
    }

    double* state(std::size_t point) { return states[point / block_size].data() + first[point]; }
    const double* state(std::size_t point) const { return states[point / block_size].data() + first[point]; }
    /// Bytes held.
    std::size_t memory() const;
};

/// The bonds of a point whose state it holds: a family from bond `first` on, in packs of their own.
template <class Value>
struct HeldBondsOf {
    std::size_t first;
    std::size_t count;
    std::size_t packs;
    std::size_t rows; ///< of a bond
    const std::uint32_t* neighbours;
    Value* state;

    /// Number of bonds in a pack: pack_width but for the last.
    std::size_t bonds_in(std::size_t pack) const { return std::min(pack_width, count - pack * pack_width); }
    /// The same as lane bits.
    std::uint8_t lanes(std::size_t pack) const { return first_lanes(bonds_in(pack)); }
    /// Doubles of their state.
    std::size_t values() const { return packs * rows * pack_width; }
    /// First of the rows of one of these bonds; its rows are pack_width apart.
    Value* bond(std::size_t held) const { return state + held / pack_width * rows * pack_width + held % pack_width; }
};
using HeldBonds = HeldBondsOf<double>;
using ConstHeldBonds = HeldBondsOf<const double>;

/// Seconds that a few points took of an evaluation, by its parts; only their ratios mean something.
struct OperatorSamples {
    double kinematics = 0.0;
    double material = 0.0;
    double force = 0.0;

    OperatorSamples& operator+=(const OperatorSamples& other)
    {
        kinematics += other.kinematics, material += other.material, force += other.force;
        return *this;
    }
};

struct Model {
    double spacing = 0.0; ///< dx [m]
    double horizon = 0.0; ///< delta [m]
    Vector3 gravity = Vector3::Zero();
    std::vector<Body> bodies;
    std::vector<Obstacle> obstacles;
    Points points;
    IsometryTable isometries;
    bool wet = false; ///< has some point suction or saturation? As update_records() found it.
    Families families;
    bool has_sub_horizons = true;  ///< does the force state in use ask for them?
    bool has_shared_bonds = false; ///< do (i,j) and (j,i) have one state? Then the point of smaller number holds it
    SubHorizons sub_horizons;
    Halos halos;
    BondData bonds;

    /// Mean stress and state variables of each point, `state_stride` doubles a point, from the last refresh; what a
    /// free grain remembers.
    std::vector<double> point_state;
    std::size_t state_stride = 0;

    std::vector<Vector3> refresh_position;  ///< positions that the families were found from
    AlignedVector<NeighbourRecord> records; ///< of points, then images

    /// Within an evaluation: what gathers at the places of the halos, and what points and images lend to their bonds, a
    /// few doubles each.
    AlignedVector<double> at_places;
    AlignedVector<double> lent;

    // Outcome of the last evaluation of the operator, point by point.
    std::vector<Vector3> internal_force; ///< [N]
    std::vector<double> volume_rate;     ///< tr L dt [-]
    std::vector<double> stress_work;     ///< of the step: V sum_b w_b sigma_b : D_b dt [J]
    std::vector<std::uint32_t> inactive_bonds;
    std::vector<std::uint8_t> free_grain; ///< 1: no active bond
    OperatorSamples operator_samples;     ///< of this evaluation, or since they were set to zero

    /// What a checkpoint keeps besides families and bonds.
    template <class Self, class Visit>
    static void members(Self& self, Visit& visit)
    {
        visit.part("points", self.points);
        visit("refresh_position", exactly(self.refresh_position, self.size()));
        visit("point_state", any_reals(self.point_state));
        visit("inactive_bonds", self.inactive_bonds);
        visit("free_grain", self.free_grain);
        visit.part("images", self.isometries);
        for (std::size_t o = 0; o < self.obstacles.size(); ++o)
            visit("obstacle/" + std::to_string(o) + "/shift", self.obstacles[o].shift);
    }

    std::size_t size() const { return points.size(); }
    const Body& body_of(std::size_t point) const { return bodies[points.body[point]]; }
    std::size_t rows(std::size_t point) const { return body_of(point).rows(); }

    /// Bonds to images are held by both ends: their states are mirrored.
    HeldBonds held(std::size_t point) { return held_bonds(point, families[point], bonds.state(point)); }
    ConstHeldBonds held(std::size_t point) const { return held_bonds(point, families[point], bonds.state(point)); }
    /// The same of a family that the point had, and its states.
    ConstHeldBonds held(std::size_t point, const FamilyView& family, const double* state) const
    {
        return held_bonds(point, family, state);
    }
    /// First of the rows of bond b of a point, held by whichever end; rows are pack_width apart.
    double* bond_state(std::size_t point, std::size_t b)
    {
        const Holder holder = holder_of(point, b);
        return held(holder.point).bond(holder.held);
    }
    const double* bond_state(std::size_t point, std::size_t b) const
    {
        const Holder holder = holder_of(point, b);
        return held(holder.point).bond(holder.held);
    }
    /// Lays out the states of the bonds of a block of points for the families as they are; values are not set.
    void lay_out_bonds(std::size_t block);

    /// Sets the sizes of everything that has one value a point.
    void allocate();
    /// Families, and what follows from them, at the current positions. The states of bonds are not touched; none is
    /// active.
    void find_families();
    /// What a refresh replaces.
    struct Replaced {
        Families families;
        ActiveBonds active;
    };
    /// The same for families that follow from those until now, see FamilyRule.
    /// @return those until now
    /// @throws what Families::find() throws; the model is then what it was
    Replaced renew_families(std::span<const ClosedPair> closed = {});
    /// The same with families that a checkpoint kept, for the positions that they were found from.
    void restore_families(const Families::Kept& kept);
    /// Copies positions, velocities and volumes of points and images to the records.
    void update_records();
    /// Bytes held in points, families and bonds.
    std::size_t memory() const;

private:
    Families families_now(const Families* before, std::span<const ClosedPair> closed);
    void follow_families();
    template <class Value>
    HeldBondsOf<Value> held_bonds(std::size_t point, const FamilyView& family, Value* state) const
    {
        const std::size_t first = has_shared_bonds ? family.lower : 0;
        const std::size_t count = family.count - first;
        return {first, count, (count + pack_width - 1) / pack_width, rows(point), family.neighbours + first, state};
    }
    /// Who holds bond b of a point, and as which of its held bonds.
    struct Holder {
        std::size_t point;
        std::size_t held;
    };
    Holder holder_of(std::size_t point, std::size_t b) const;
};

} // namespace periporo
