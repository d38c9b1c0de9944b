// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Suction and saturation of the points: at the start of a run, and as its stages change them. Nothing flows: each point
// keeps the suction that the case gives it. Its mass is that of its grains and of the water that the pores it began
// with hold, m = (rho_s (1 - phi0) + S_r(s, phi0) phi0 rho_w) V0: a volume that changes takes up no water, a suction
// that changes does.
#pragma once

#include "case/description.hpp"
#include "model/model.hpp"
#include "periporo/retention.hpp"
#include "plugins/registry.hpp"
#include "time/energy_ledger.hpp"

#include <cstddef>
#include <memory>
#include <vector>

namespace periporo {

inline constexpr double water_density = 1000.0; ///< rho_w [kg/m3]

class Water {
public:
    Water() = default;
    Water(const CaseDescription& description, const PluginRegistry& registry);

    /// Sets suction and saturation of the points of a body, those from `first` on, to what the case begins with.
    void begin_body(Model& model, std::size_t body, std::size_t first) const;

    /// What the points have now is what they have before the changes of the stage.
    void begin_stage(const Model& model, const StageDescription& stage);

    /// Suction, saturation and mass a time after the stage began [s]: the suction goes evenly from one value to the
    /// other, the saturation follows the curve of the material at the porosity of the moment. Costs nothing where
    /// nothing changes.
    /// @returns what the water that came brought with it, less what the water that went took
    ArrivedEnergy follow(Model& model, double time);
    /// Are the changes of the stage over?
    bool settled() const { return settled_; }
    /// How long after the beginning of the stage the last of its changes ends [s].
    double last_change() const { return longest_; }

    /// What a checkpoint must keep.
    const WaterCourse& course() const { return course_; }
    /// Goes on in a stage that had begun.
    void restore(WaterCourse course, const StageDescription& stage);

private:
    /// The material of a body, its curve, and how long the change of a stage takes.
    struct BodyWater {
        const MaterialDescription* material = nullptr;
        std::shared_ptr<const Retention> curve; ///< null: the case gives the saturation
        double over = 0.0;                      ///< [s]
        double way(double time) const;          ///< share of the change that is done [-]
    };
    double saturation(std::size_t body, const WaterDescription& water, double suction, double porosity) const;
    /// Of a point on its way from what it has before the stage to what it has after it.
    double saturation_on_the_way(const BodyWater& body, std::size_t point, double way, double porosity) const;
    void set_durations(const StageDescription& stage);

    const CaseDescription* description_ = nullptr;
    std::vector<BodyWater> bodies_;
    WaterCourse course_;
    double longest_ = 0.0;          ///< of the changes of the stage [s]
    bool settled_ = true;           ///< are all changes over?
    bool follows_porosity_ = false; ///< does some curve?
};

/// phi = 1 - (1 - phi0) V0/V: the grains of a point stay [-].
double porosity_of(const Model& model, std::size_t point);

} // namespace periporo
