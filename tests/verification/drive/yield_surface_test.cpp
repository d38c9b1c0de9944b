// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The yield surface that is found by asking the law lies where the law's formula puts it.
#include "drive/yield_surface.hpp"
#include "support/paths.hpp"

using namespace periporo;
using namespace periporo::test;

namespace {

constexpr double strength = 50e3; // of the law below [Pa]

/// Mises' law without hardening: q <= strength at any p.
struct Metal {
    static constexpr std::size_t state_count = 0;
    static std::vector<Parameter> parameters() { return {}; }
    static std::vector<StateVariable> state_variables() { return {}; }
    explicit Metal(const Parameters&) {}
    double bulk_modulus() const { return 2e9; }
    double shear_modulus() const { return 1e9; }
    template <class Real>
    LawResult<Real, 0> update(const LawInput<Real, 0>& old) const
    {
        const SymmetricTensor<Real> trial =
            elastic_stress(old.stress, old.strain_increment, bulk_modulus(), shear_modulus());
        const SymmetricTensor<Real> shear = deviator(trial);
        const Real q = square_root(Real(1.5 * double_contraction(shear, shear)));
        const Real factor = select(q > Real(strength), Real(strength / q), Real(1.0));
        return {trial - shear * Real(1.0 - factor), {}};
    }
    template <class Real>
    std::array<Real, 0> initial_state(const LawInput<Real, 0>&, double) const
    {
        return {};
    }
};

} // namespace

TEST_CASE("the silt's surface is the ellipse q2/M2 + p (p - pc) = 0, wherever the point stands")
{
    const std::string start = "[initial]\npressure = \"100 kPa\"\noverconsolidation_ratio = ";
    const std::string stage = "\n[[stage]]\nduration = 1\ntype = \"triaxial_drained\"\naxial_compression = 0.3";
    for (const std::string overconsolidation : {"1.0", "1.25", "8.0"}) {
        CAPTURE(overconsolidation);
        const DrivenPath path(silt + start + overconsolidation + stage);
        for (const MaterialPoint* point : {&path.start(), &path.end()}) {
            const double pc = std::exp(point->state(ViscoplasticCriticalState::log_preconsolidation));
            const std::vector<TriaxialStress> surface = yield_surface(*point, 200e3);
            REQUIRE(surface.size() == 181); // closed: an end in every direction
            for (const TriaxialStress& stress : surface)
                // a stress counts as inside within 1e-9 of what the law returns; the normal of the flat end of the
                // ellipse makes of it some 1e-8 of pc2
                CHECK(std::abs(stress.q * stress.q / 1.21 + stress.p * (stress.p - pc)) <= 1e-7 * pc * pc);
            CHECK(surface.front().p == doctest::Approx(pc).epsilon(1e-7));
        }
    }
}

TEST_CASE("a law that is elastic everywhere has no surface")
{
    const DrivenPath path(rubber + "[initial]\npressure = \"1 kPa\"\n[[stage]]\nduration = 1\ntype = \"isotropic\"\n"
                                   "pressure = \"2 kPa\"");
    CHECK(yield_surface(path.end(), 2e3).empty());
}

TEST_CASE("an open surface is found where it is and has no points where it does not end")
{
    const LawMaterial<Metal> metal{Parameters{}};
    for (const SymmetricTensor<double>& stress : {SymmetricTensor<double>{}, SymmetricTensor<double>::isotropic(1e5),
                                                  SymmetricTensor<double>{0, 0, -5e4, 0, 0, 0}}) {
        const std::vector<TriaxialStress> surface = yield_surface(MaterialPoint(metal, stress), strength);
        REQUIRE(surface.size() > 100);
        CHECK(surface.size() < 181); // none along the p axis
        for (const TriaxialStress& end : surface)
            // a stress counts as inside within 1e-9 of its size and of its distance from the middle
            CHECK(std::abs(end.q - strength) <= 1e-8 * (std::abs(end.p) + end.q));
    }
}
