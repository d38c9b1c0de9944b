// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The settled vertical stress, layer by layer, against the weight above.
#pragma once

#include "model/model.hpp"
#include "operator/force_state.hpp"

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <vector>

namespace periporo {

struct VerticalStress {
    struct Layer {
        double depth;    ///< mean of the points, below the top of the body [m]
        double stress;   ///< mean vertical stress, effective + S_r s, tension-positive: the total
                         ///< stress without the pressure of standing water [Pa]
        double expected; ///< mean of -(weight less buoyancy of the body above, over the area) [Pa]
    };
    std::vector<Layer> layers;      ///< from the top, one spacing each
    double largest_deviation = 0.0; ///< of a layer, over the stress expected at the bottom [-]
    /// The same over the layers more than a horizon below the top and above the bottom; 0 when there are none. Nearer
    /// to a surface the families are one-sided, and the reaction of a floor acts on one row.
    double inner_deviation = 0.0;
};

/// Layers of one spacing across a body; nothing without gravity, nor for a body like a slope, whose layers are not
/// equally wide and carry more or less than what lies straight above. What stands on the body is not seen.
std::optional<VerticalStress> vertical_stress(const Model& model, const ForceState& force_state, std::uint32_t body);

nlohmann::json to_json(const VerticalStress& profile);

} // namespace periporo
