// my plugin: two points that come near repel each other with a linear spring and a dashpot.
//
// Make it yours: parameters() and evaluate(). Finding the contacts, Newton's third law, friction, the stable step and
// the energy ledger are the framework's.
#pragma once

#include <periporo/contact.hpp>

#include <span>
#include <vector>

namespace lab {

using namespace periporo;

/// Normal force k o + 2 zeta sqrt(k m) do/dt for an overlap o > 0 and the reduced mass m of the pair, that of the point
/// at a rigid surface. It never pulls.
class MyPlugin : public periporo::Contact {
public:
    /// What a case gives. Values arrive checked and in SI units; `periporo inspect my_plugin` prints this list.
    static std::vector<Parameter> parameters()
    {
        return {Parameter::real("stiffness", dimension::spring, "Spring k of one contact").above(0.0),
                Parameter::real("damping_ratio", dimension::none, "zeta of the dashpot; 1 for critical damping")
                    .at_least(0.0)
                    .at_most(1.0)
                    .by_default(0.0),
                Parameter::real("reach", dimension::none, "Distance of first touch, in spacings")
                    .above(0.0)
                    .at_most(1.0)
                    .by_default(0.8),
                Parameter::real("friction", dimension::none, "Coulomb coefficient of friction").at_least(0.0)};
    }

    explicit MyPlugin(const Parameters& parameters)
        : stiffness_(parameters.real("stiffness")), damping_ratio_(parameters.real("damping_ratio")),
          reach_(parameters.real("reach")), friction_(parameters.real("friction"))
    {
    }

    /// Called once, before anything else: here lengths of the discretization become known.
    void scale(const ContactScale& scale) override { cutoff_ = reach_ * scale.spacing; }

    double cutoff() const override { return cutoff_; }
    double friction() const override { return friction_; }

    /// Each pair by itself. The stiffness bounds the time step, stored energy and damping force go to the energy
    /// ledger.
    void evaluate(std::span<const ContactPair> pairs, std::span<ContactResponse> responses) const override
    {
        for (std::size_t i = 0; i < pairs.size(); ++i)
            responses[i] = response(pairs[i]);
    }

private:
    ContactResponse response(const ContactPair& pair) const
    {
        return spring_and_dashpot(cutoff_ - pair.distance, stiffness_, damping_ratio_, pair);
    }

    double stiffness_;     // [N/m]
    double damping_ratio_; // [-]
    double reach_;         // [spacings]
    double friction_;      // [-]
    double cutoff_ = 0.0;  // [m]
};

} // namespace lab
