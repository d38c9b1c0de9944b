// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
#include "plugins/fit_contact.hpp"

#include <fmt/format.h>

#include <stdexcept>

namespace periporo {

void fit_contact(Contact& law, double spacing, double horizon, bool between_surfaces)
{
    const bool own_surface = law.surface() != nullptr;
    if (own_surface && between_surfaces)
        throw std::runtime_error("the law brings a surface of its own; name only the bodies that touch it");
    law.scale({spacing, horizon, own_surface || between_surfaces ? ContactPartner::surface : ContactPartner::points});
    if (law.cutoff() >= horizon)
        throw std::runtime_error(fmt::format("its cut-off {:.4g} m is not shorter than the horizon {:.4g} m; contacts "
                                             "are looked for within the horizon",
                                             law.cutoff(), horizon));
}

} // namespace periporo
