// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The initial states of points.
#include "state/state.hpp"

#include <algorithm>

namespace periporo {

void State::reset_point_states()
{
    point_states.stride = 0;
    for (const Body& body : bodies)
        point_states.stride = std::max(point_states.stride, body.rows());
    point_states.values.assign(size() * point_states.stride, 0.0);
    for (std::size_t i = 0; i < size(); ++i) {
        const std::vector<StateVariable>& variables = body_of(i).material->state_variables();
        for (std::size_t s = 0; s < variables.size(); ++s)
            point_states[i][6 + s] = variables[s].initial;
    }
}

} // namespace periporo
