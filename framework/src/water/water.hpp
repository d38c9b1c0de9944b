// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Pore pressure and saturation of the points: at the start of a run, and as its stages change them. Nothing flows: each
// point keeps the suction that the case gives it, and what comes under the surface of standing water fills with it.
//
// The mass of a point is that of its grains and of the water that the pores it began with hold,
// m = (rho_s (1 - phi0) + S_r(s, phi0) phi0 rho_w) V0: a volume that changes takes up no water, a suction that changes
// does. Under water the pores stay full, m = rho_s (1 - phi0) V0 + rho_w (V - (1 - phi0) V0): less the buoyancy
// rho_w g V, what weighs there is always that of the grains in water.
#pragma once

#include "case/description.hpp"
#include "model/model.hpp"
#include "periporo/retention.hpp"
#include "plugins/registry.hpp"
#include "water/arrived_energy.hpp"
#include "water/mixture.hpp"

#include <cstddef>
#include <memory>
#include <vector>

namespace periporo {

class StandingWater;

class Water {
public:
    Water() = default;
    Water(const CaseDescription& description, const PluginRegistry& registry);

    /// Sets the water levels of the bodies, and pore pressure, saturation and mass of all points, to what the case
    /// begins with.
    void begin(Model& model);

    /// The water that the points have now is the one before the changes of the stage.
    void begin_stage(const Model& model, const StageDescription& stage);

    /// Sets pore pressure, saturation and mass of the points a time after the stage began [s]. The pressure goes evenly
    /// from one value to the other, and so does a water level; the saturation follows the curve of the material at the
    /// porosity of the moment. Costs nothing where nothing changes.
    /// @param time_step of the step that follows: the weight of the new water acts on it from the middle of this step
    /// on, since the forces at its start still have the old masses; 0 if the forces are renewed before [s]
    /// @returns the energy of the water that arrived, less that of the water that left
    ArrivedEnergy follow(Model& model, double time, double time_step = 0.0);
    /// Are the changes of the stage over?
    bool settled() const { return settled_; }
    /// How long after the beginning of the stage the last of its changes ends [s].
    double last_change() const { return longest_; }

    template <class Self, class Visit>
    static void members(Self& self, Visit& visit)
    {
        visit.part("course", self.course_);
        visit("settled", self.settled_);
    }
    /// Sets what follows from the members: goes on in a stage that had begun.
    void resume(Model& model, const StageDescription& stage);

private:
    /// The material of a body, its curve, and the change of its water in a stage.
    struct BodyWater {
        const MaterialDescription* material = nullptr;
        std::shared_ptr<const Retention> curve; ///< null: the case gives the saturation
        bool changes = false;                   ///< in this stage
        double over = 0.0;                      ///< duration of the change [s]
        double done(double time) const;         ///< share of the change that is done [-]
    };
    double given_saturation(std::size_t body, const WaterDescription& water, double pressure, double porosity) const;
    /// Interpolates the saturation of a point out of standing water between the start and the end of the change.
    double own_saturation(std::size_t point, std::size_t body, double porosity) const;
    /// Interpolates the water level of a body [m].
    double level(std::size_t body) const;
    void set_durations(const StageDescription& stage);
    void begin_change(const Model& model, std::size_t body, const WaterDescription& water);
    /// Sets pore pressure and saturation of a point.
    void fill(Model& model, std::size_t point, const StandingWater& standing);
    /// Mass of a point with the water that it holds [kg].
    double mass_of(const Model& model, std::size_t point) const;

    const CaseDescription* description_ = nullptr;
    std::vector<BodyWater> bodies_;
    WaterCourse course_;
    double longest_ = 0.0;          ///< of the changes of the stage [s]
    bool settled_ = true;           ///< are all changes over?
    bool follows_porosity_ = false; ///< does some curve?
};

} // namespace periporo
