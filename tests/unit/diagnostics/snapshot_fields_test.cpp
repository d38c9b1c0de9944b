// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Fields of a snapshot that say the same thing in different words.
#include "diagnostics/snapshot_fields.hpp"
#include "support/specimens.hpp"

#include <algorithm>
#include <doctest/doctest.h>

using namespace specimens;

TEST_CASE("volume, volume ratio, density and porosity of a point describe one volume, and a gap is apart from it")
{
    const double dx = 0.01, porosity = 0.3;
    const auto force = make_force_state("energy_conjugate", Influence::by_name("linear", 3.015 * dx));
    Model model = from_positions(lattice(4, 4, 4, dx), dx);
    model.state.bodies[0].porosity = porosity;
    find_first_families(model, *force);
    force->evaluate(model, {StressUpdate::keep, MaterialResponse::full, 0.0});
    for (std::size_t i = 0; i < model.size(); ++i) {
        Points& points = model.state.points;
        points.jacobian[i] = 0.5 + 0.05 * static_cast<double>(i); // from denser than its grains to a wide gap
        points.volume[i] = points.initial_volume[i] * volume_ratio(points.jacobian[i], porosity);
    }
    SnapshotFields fields;
    const std::vector<FieldView>& all = fields.collect(model, *force);
    const auto field = [&](const char* name) {
        const auto at = std::find_if(all.begin(), all.end(), [&](const FieldView& f) { return f.name == name; });
        REQUIRE(at != all.end());
        return at->values;
    };
    const auto volume = field("volume"), ratio = field("volume_ratio"), gap = field("gap_ratio"),
               density_field = field("density"), porosity_field = field("porosity");
    for (std::size_t i = 0; i < model.size(); ++i) {
        const double v0 = model.state.points.initial_volume[i], j = model.state.points.jacobian[i];
        const auto rounded = [](double value) { return doctest::Approx(value).epsilon(1e-12); };
        CHECK(volume[i] == rounded(ratio[i] * v0));
        CHECK(density_field[i] * ratio[i] == rounded(density));                 // the mass is constant
        CHECK((1.0 - porosity_field[i]) * ratio[i] == rounded(1.0 - porosity)); // and so are the grains
        CHECK(porosity_field[i] >= 0.0);
        if (j >= 1.0 - porosity)
            CHECK(ratio[i] + gap[i] == rounded(j));
        else
            CHECK(gap[i] == 0.0);
    }
}
