// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Contact of points with rigid surfaces, with other bodies, and of free grains with everything.
#pragma once

#include "contact/smoothed_surface.hpp"
#include "contact/way_out.hpp"
#include "model/model.hpp"
#include "periporo/contact.hpp"

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace periporo {

/// One contact law at work: between the named bodies and a rigid surface, which is an obstacle or the law's own;
/// between two different bodies, point against point or point against smoothed surface; or, where `bodies` names one
/// body twice, between its pieces that are apart, and between its free grains and all its points. Points of one family
/// that carry stress need no contact.
struct ContactAssignment {
    std::shared_ptr<const Contact> law;
    std::vector<std::uint32_t> bodies;
    std::optional<std::uint32_t> obstacle = {};     ///< of the model
    std::optional<std::uint32_t> surface_body = {}; ///< the one of two bodies whose smoothed surface is touched
};

/// How moving obstacles take part in the energy of a step [W].
struct ObstaclePower {
    double reaction = 0.0; ///< of all forces on points, with the velocities of the obstacles
    double friction = 0.0; ///< the part of friction
    double damping = 0.0;  ///< the part of what does not come from stored energy
};

/// A point that went through an obstacle.
struct Crossing {
    std::size_t assignment;
    std::uint32_t point;
};

/// Stiffness and damping of a point against the ground, over its mass, that together with those of all others are
/// nowhere below what contact adds: with blocks S_i and C_i, sum u_i . S_i u_i m_i is at least twice the energy of the
/// contacts for all displacements u, and the same holds of C_i and the power of the dashpots.
struct ContactBound {
    Eigen::Matrix3d stiffness = Eigen::Matrix3d::Zero(); ///< [1/s2]
    Eigen::Matrix3d damping = Eigen::Matrix3d::Zero();   ///< [1/s]
    double sharpest = 0.0; ///< square of the largest angular frequency of one contact alone [1/s2]
};

/// Finds contacts and adds their forces. Each point sums its own contacts, both directions of a pair are evaluated with
/// the same numbers, so that forces are opposite to the last bit and independent of threads.
class ContactForces {
public:
    explicit ContactForces(std::vector<ContactAssignment> assignments)
        : assignments_(std::move(assignments)), candidates_(assignments_.size()), near_surface_(assignments_.size()),
          room_(assignments_.size()), free_place_(assignments_.size()), deepest_(assignments_.size(), 0.0),
          crossed_points_(assignments_.size(), 0)
    {
    }

    /// What may touch before the next refresh. To be called after every refresh.
    /// @param slack how much closer a pair of points may come until then [m]
    void find_candidates(const Model& model, double slack);
    /// Pairs of points of one body that are apart, touch, and have come to rest against each other: the motion of the
    /// pair has no more than a tenth of the energy that its contact stores, and the material closes. Sorted, with both
    /// directions of each pair. Records must be current.
    std::vector<ClosedPair> closed_pairs(const Model& model) const;
    /// Energy that the contacts within bodies store at the positions of the records [J].
    double energy_within_bodies(const Model& model);

    /// Of each point the energy that it stores on smoothed surfaces, at the positions of the records [J]. Find support
    /// anew, and the surface may be another: what a point then stores less is lost.
    void energy_on_smoothed(const Model& model, std::vector<double>& energy);

    /// A point that lies deep in a rigid surface when that first acts, as a lattice puts it that does not follow the
    /// surface, takes the room that it finds: its reach is its distance, and grows to the whole when it moves away.
    /// With the whole reach at once the overlap would be energy from nowhere. To be called when a stage begins.
    void make_room(const Model& model);
    /// Looks again for points near rigid surfaces if either have moved far since that was done. To be called in every
    /// step.
    void follow_surfaces(const Model& model);

    /// What the laws are told of the approach of points: as it is, or, while a body settles under artificial damping,
    /// nothing; that damping would multiply the dashpots of a law beyond stability.
    enum class Approach { real, none };

    /// Adds normal forces of all laws and friction between bodies to `force`. Records must be current, with mid-step
    /// velocities.
    /// @param time_step within which friction may stop a slip, longer where its force will be multiplied [s]
    void add_reactions(const Model& model, double time_step, Approach approach, std::vector<Vector3>& force);

    /// Adds Coulomb friction on rigid surfaces, last of all forces: it takes from the tangential force and momentum of
    /// the point what stops its slip within the step, but not more than mu F_n.
    void add_surface_friction(const Model& model, double time_step, std::vector<Vector3>& force);

    /// What moving obstacles did in the last step.
    const ObstaclePower& obstacle_power() const { return obstacle_power_; }
    /// Force of each obstacle on all points in the last step [N].
    const std::vector<Vector3>& reactions_of_obstacles() const { return obstacle_reactions_; }
    /// For each assignment the deepest overlap of the run so far, over the reach of the contact: at 1 the two points
    /// lie in one place, or a point lies in the surface; beyond that it lies behind it.
    const std::vector<double>& deepest_overlap() const { return deepest_; }
    const std::vector<ContactAssignment>& assignments() const { return assignments_; }
    /// Points that came out of an obstacle at another side than they had entered it, or jumped over it, in the last
    /// step. The obstacle has let go of them: what they had stored in the contact is lost.
    const std::vector<Crossing>& crossings() const { return crossings_; }
    /// For each assignment, how many there have been in the run so far.
    const std::vector<std::int64_t>& crossed_points() const { return crossed_points_; }

    /// What lives from step to step.
    template <class Self, class Visit>
    static void members(Self& self, Visit& visit, std::size_t points, std::size_t obstacles)
    {
        for (std::size_t a = 0; a < self.assignments_.size(); ++a) {
            visit("room/" + std::to_string(a), empty_or(self.room_[a], points));
            visit("free_place/" + std::to_string(a), any_reals(empty_or(self.free_place_[a], points)));
        }
        visit("searched", empty_or(self.searched_, points));
        visit("searched_shifts", empty_or(self.searched_shifts_, obstacles));
        visit("energy", self.energy_);
        visit.part("stored", self.stored_, points * self.assignments_.size());
        visit("possible", any_reals(empty_or(self.possible_, self.assignments_.size())));
        visit("deepest", self.deepest_);
        visit("crossed_points", self.crossed_points_);
        visit("grain_reach", any_reals(empty_or(self.grain_reach_, points)));
    }
    /// Sets what follows from the members. The records must have the positions of the last refresh.
    /// @param slack as for find_candidates() [m]
    /// @throws std::runtime_error when the members do not fit each other
    void resume(const Model& model, double slack);

    /// Stored in all contacts at the last add_reactions [J].
    double energy() const { return energy_; }
    /// Stored before the last add_reactions in contacts of points that have crossed since: nothing gives it back [J].
    double energy_let_go() const { return energy_let_go_; }
    /// Part of the normal force on each point that does not come from stored energy [N].
    const std::vector<Vector3>& damping() const { return damping_; }
    /// Friction force on each point at the last step [N].
    const std::vector<Vector3>& friction() const { return friction_; }

    /// Reach of each point against free grains [m]; below zero while the point is bonded, without limit if it always
    /// was. Empty before the first step.
    const std::vector<double>& grain_reach() const { return grain_reach_; }

    /// For the stable step, of every point: every law at full overlap, with the contacts that there are at the present
    /// positions and those whose gap is below a margin. Records must be current, and candidates found.
    const std::vector<ContactBound>& bounds(const Model& model);
    /// Largest angular frequency of one contact alone that the last bounds() or is_sharper() found [1/s]
    double sharpest() const { return sharpest_; }
    /// Has a contact alone more than `frequency` [1/s]? Contacts count that are present, or whose gap is below two
    /// thirds of the margin of bounds(), so that bounds() counts them too. To be called before a step: contacts that
    /// the last bounds() did not count may need a shorter one.
    bool is_sharper(const Model& model, double frequency);

private:
    struct SurfaceContact {
        std::uint32_t point;
        double friction;
        double force; ///< sum of the normal forces on all faces that take part [N]
        Vector3 normal;
        Vector3 velocity;       ///< of the surface [m/s]
        std::uint32_t obstacle; ///< of the model, or as many as it has for a law's own surface
        double energy;          ///< that the contact stores [J]
    };
    /// A point on the smoothed surface of another body.
    struct SupportedPoint {
        std::uint32_t point;
        Support support;
    };
    /// What a smoothed surface is to a point that stands on it.
    struct Carrier {
        double volume = 0.0;   ///< [m3]
        double mobility = 0.0; ///< 1/mass, when all points that press on it are pushed alike [1/kg]
    };
    /// @param crowd for every point the sum of all |w| that press on it; empty: nothing else does
    static Carrier carrier(const Model& model, const Support& support, std::span<const double> crowd);

    /// Points of bodies that may touch points of bodies before the next refresh.
    void find_candidates_among_points(const Model& model, double slack);
    void find_pairs(const Model& model, std::size_t assignment, double slack);
    /// Pieces of a body that are apart and may touch.
    void find_pairs_apart(const Model& model, std::size_t assignment, double slack);
    void find_near_surfaces(const Model& model);
    void list_near_surfaces(const Model& model);
    void add_surface(const Model& model, std::size_t assignment, std::vector<Vector3>& force);
    /// Adds the reaction of a surface on a point.
    void push(const Model& model, std::size_t assignment, const ContactPair& pair, const ContactResponse& response,
              std::uint32_t point, const WayOut& way, std::vector<Vector3>& force);
    void let_go(const Model& model, std::size_t assignment, std::uint32_t point, double distance);
    void add_smoothed(const Model& model, std::size_t assignment, double time_step, std::vector<Vector3>& force);
    /// @param reach above the surface within which points count as standing on it [m]
    void find_supported_points(const Model& model, std::size_t assignment, double reach);
    void press(const Model& model, std::size_t assignment, const SupportedPoint& supported, double time_step,
               std::vector<Vector3>& force);
    void note_overlap(std::size_t assignment, double overlap);
    /// Sets bounds_ and sharpest_ by the contacts of some assignments whose gap is below a part of the margin.
    template <class Takes>
    void find_bounds(const Model& model, double part_of_margin, const Takes& takes);
    /// @param margin gap below which a contact counts [m]
    void bound_surface(const Model& model, std::size_t assignment, double margin);
    void bound_supported(const Model& model, std::size_t assignment, double margin);
    void bound_pairs(const Model& model, std::size_t assignment, double margin);
    /// Largest angular frequency that a contact of an assignment may have, of points as they are [1/s]
    double sharpest_possible(const Model& model, std::size_t assignment) const;

    void add_pairs(const Model& model, std::size_t assignment, double time_step, std::vector<Vector3>& force);
    /// Are there points that for_each_touching() would visit? Finds them.
    bool may_touch(const Model& model, std::size_t assignment);
    /// Marks the free grains of a body, their neighbours, and points with candidates; false when there are none.
    bool find_concerned(const Model& model, std::size_t assignment);
    /// Calls visit(point, neighbours that it may touch, reach) for every point that may touch another under a law
    /// between points, with reach(point of the neighbour) [m]. In parallel.
    template <class Visit>
    void for_each_touching(const Model& model, std::size_t assignment, const Visit& visit) const;
    /// Sums the contacts of a point with `neighbours`, no farther apart than reach(neighbour's point).
    template <class Reach>
    void gather_pairs(const Model& model, const Contact& law, std::uint32_t point,
                      std::span<const std::uint32_t> neighbours, const Reach& reach, double time_step,
                      std::vector<Vector3>& force);
    void update_grain_reach(const Model& model, const ContactAssignment& assignment);

    std::vector<ContactAssignment> assignments_;
    /// For each assignment, neighbours (points and images) of each point in compressed rows.
    struct Candidates {
        std::vector<std::size_t> first;
        std::vector<std::uint32_t> neighbours;

        std::span<const std::uint32_t> of(std::size_t point) const
        {
            if (neighbours.empty())
                return {};
            return {neighbours.data() + first[point], first[point + 1] - first[point]};
        }
    };
    std::vector<Candidates> candidates_;
    std::vector<std::vector<std::uint32_t>> near_surface_; ///< for each assignment, points near its rigid surface
    std::vector<std::vector<double>>
        room_; ///< for each assignment, once its rigid surface acts, the reach of each point
    /// For each assignment to an obstacle, where each point near it last was, or would be, without touching, as the
    /// obstacle lies in its geometry [m]; not a number for points that have not been near. It tells from which side a
    /// point came.
    std::vector<std::vector<Vector3>> free_place_;
    std::vector<Crossing> crossings_;       ///< in the last step
    std::vector<Vector3> searched_;         ///< positions of the points when near_surface_ was found [m]
    std::vector<Vector3> searched_shifts_;  ///< of the obstacles [m]
    std::vector<SmoothedSurface> smoothed_; ///< for each assignment
    std::vector<SupportedPoint> supported_; ///< on a smoothed surface now; only ever grows
    std::size_t supported_count_ = 0;
    std::vector<double> shared_weight_; ///< of each point of a smoothed surface: sum of |w| of those that stand on it
    std::vector<double> overlap_;       ///< of each point with other points, over their reach
    std::vector<double> deepest_;
    std::vector<std::int64_t> crossed_points_;
    ObstaclePower obstacle_power_;
    std::vector<Vector3> obstacle_reactions_; ///< and that of the laws' own surfaces [N]
    /// Contacts of each point under the assignment at hand. Friction that stops the slip of a pair within a step is
    /// divided by the larger number of its two ends: together they stop a point and never throw it back.
    std::vector<std::uint32_t> contacts_of_;
    std::vector<std::uint8_t> concerned_; ///< 1: the point may touch another of its body
    std::vector<Vector3> friction_;
    std::vector<SurfaceContact> surface_contacts_;
    /// What each point stored in contacts with rigid surfaces at the last evaluation.
    struct Stored {
        std::vector<std::uint32_t> point;
        std::vector<std::uint32_t> obstacle; ///< as SurfaceContact::obstacle
        std::vector<double> energy;          ///< [J]

        template <class Self, class Visit>
        static void members(Self& self, Visit& visit, std::size_t most)
        {
            visit("point", at_most(self.point, most));
            visit("obstacle", at_most(self.obstacle, most));
            visit("energy", at_most(self.energy, most));
        }
    };
    Stored stored_;
    double energy_let_go_ = 0.0;
    std::vector<ContactBound> bounds_;
    double sharpest_ = 0.0;
    std::vector<double> possible_; ///< for each assignment sharpest_possible() at the last bounds(), or none [1/s]
    std::vector<double> point_energy_;
    std::vector<Vector3> damping_;
    /// A grain that comes loose among others takes the room it finds: its reach starts at the distance of its nearest
    /// neighbour and grows, up to the cut-off, as it moves away. With the whole cut-off at once the overlap it is born
    /// with would be energy from nowhere: in a trial 15 per cent of the energy of the collapse from a single grain. It
    /// keeps that reach against other grains when it bonds again: a pair that had the reach of one end must not find
    /// itself overlapping with that of the other (in a sliding sheet 4 per cent of the energy from two grains).
    std::vector<double> grain_reach_;
    double energy_ = 0.0;
    double approach_factor_ = 1.0; ///< 0 for Approach::none
    double law_step_ = 0.0;        ///< that the laws are told, see ContactPair::time_step [s]
};

} // namespace periporo
