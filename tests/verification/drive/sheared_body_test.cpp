// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// A path of simple shear gives what the operator gives for a body that is sheared so.
#include "support/paths.hpp"
#include "support/specimens.hpp"
#include "time/dynamics.hpp"

using namespace periporo::test;
using namespace specimens;

TEST_CASE("a point on a path of simple shear has the stress of every point of a body in simple shear")
{
    constexpr double dx = 0.01, gamma = 0.6, rate = 10.0;
    constexpr int steps = 600;
    const DrivenPath path(rubber + "[initial]\npressure = 0\n[[stage]]\ntype = \"simple_shear\"\nduration = 1\n" +
                          "vertical = \"constant_height\"\nshear_strain = 0.6\nsteps = 600\n");
    const SymmetricTensor<double> wanted = path.end().stress();

    for (const char* state : {"energy_conjugate", "bond_projection"}) {
        CAPTURE(state);
        Model model = from_positions(lattice(4, 3, 4, dx), dx);
        const auto force = make_force_state(state, Influence::by_name("linear", model.state.horizon));
        find_first_families(model, *force);
        ContactForces contact(std::vector<ContactAssignment>{});
        Dynamics dynamics(model, *force, contact, {0.1 * dx, false});
        std::vector<HeldDirection> held;
        for (std::uint32_t i = 0; i < model.size(); ++i)
            for (Eigen::Index c = 0; c < 3; ++c)
                held.push_back({i, Vector3::Unit(c), c == 0 ? rate * model.state.points.position[i].z() : 0.0});
        dynamics.hold(held);
        dynamics.start();
        for (int n = 0; n < steps; ++n)
            dynamics.step({gamma / rate / steps, MaterialResponse::full, 0.0});
        std::vector<double> means = model.state.point_states.values;
        mean_point_states(model, *force, means);
        const double shear_modulus = model.state.bodies[0].material->shear_modulus();
        for (std::size_t i = 0; i < model.size(); ++i) {
            // the operator turns the old stress by the whole angle of a step: half a step of 0.001 behind
            const double off = 1e-3 * shear_modulus;
            CHECK(std::abs(means[6 * i + 0] - wanted.xx) < off);
            CHECK(std::abs(means[6 * i + 2] - wanted.zz) < off);
            CHECK(std::abs(means[6 * i + 5] - wanted.xz) < off);
        }
    }
}
