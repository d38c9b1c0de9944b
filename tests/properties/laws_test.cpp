// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// What holds for every law that is written once for a point: also that packs give what doubles give.
#include "material/drucker_prager/drucker_prager.hpp"
#include "material/j2_plasticity/j2_plasticity.hpp"
#include "material/linear_elastic/linear_elastic.hpp"
#include "material/mohr_coulomb/mohr_coulomb.hpp"
#include "material/mu_i_rheology/mu_i_rheology.hpp"
#include "material/viscoplastic_critical_state/viscoplastic_critical_state.hpp"
#include "support/material_examples.hpp"

#include <doctest/doctest.h>

using namespace periporo;
using namespace periporo::test;

namespace {

template <class Law>
void check_examples(const std::string& plugin)
{
    for (const MaterialExample& example : material_examples(plugin, Law::parameters())) {
        const std::vector<std::string> faults = kit::check_law<Law>(example.parameters, example.range);
        for (const std::string& fault : faults)
            MESSAGE(example.name << ": " << fault);
        CHECK(faults.empty());
    }
}

} // namespace

TEST_CASE("linear elasticity passes the checks of a law with each of its examples")
{
    check_examples<LinearElastic>("linear_elastic");
}

TEST_CASE("the critical-state law passes the checks of a law with each of its examples")
{
    check_examples<ViscoplasticCriticalState>("viscoplastic_critical_state");
}

TEST_CASE("Drucker-Prager passes the checks of a law with each of its examples")
{
    check_examples<DruckerPrager>("drucker_prager");
}

TEST_CASE("Mohr-Coulomb passes the checks of a law with each of its examples")
{
    check_examples<MohrCoulomb>("mohr_coulomb");
}

TEST_CASE("J2 plasticity passes the checks of a law with each of its examples")
{
    check_examples<J2Plasticity>("j2_plasticity");
}

TEST_CASE("the mu(I) rheology passes the checks of a law with each of its examples")
{
    check_examples<MuIRheology>("mu_i_rheology");
}
