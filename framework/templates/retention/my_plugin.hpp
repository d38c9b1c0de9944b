// my plugin: a water retention curve of two parameters (Brooks and Corey 1964, without residual water).
//
// Make it yours: parameters() and saturation().
#pragma once

#include <periporo/retention.hpp>

#include <cmath>
#include <vector>

namespace lab {

using namespace periporo;

/// S_r = (s_a/s)^lambda beyond the suction s_a at which air enters, and 1 below it.
class MyPlugin : public periporo::Retention {
public:
    /// What a case gives. Values arrive checked and in SI units; `periporo inspect my_plugin` prints this list.
    static std::vector<Parameter> parameters()
    {
        return {
            Parameter::real("air_entry", dimension::pressure, "Suction s_a at which air enters").above(0.0),
            Parameter::real("pore_size_index", dimension::none, "Exponent lambda; small when pores are of many sizes")
                .above(0.0)};
    }

    explicit MyPlugin(const Parameters& parameters)
        : air_entry_(parameters.real("air_entry")), pore_size_index_(parameters.real("pore_size_index"))
    {
    }

    /// S_r within 0..1 at a suction [Pa]; it must not rise with the suction.
    double saturation(double suction, double /*porosity*/) const override
    {
        return suction > air_entry_ ? std::pow(air_entry_ / suction, pore_size_index_) : 1.0;
    }

    /// Leave this out when saturation() uses the porosity.
    bool depends_on_porosity() const override { return false; }

private:
    double air_entry_;       // [Pa]
    double pore_size_index_; // [-]
};

} // namespace lab
