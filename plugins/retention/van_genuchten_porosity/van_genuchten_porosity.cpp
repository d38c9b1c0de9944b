// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Van Genuchten's curve with an air-entry value that follows the void ratio: the plugin retention
// "van_genuchten_porosity".
#include "../common/van_genuchten_shape.hpp"
#include "periporo/retention.hpp"

#include <algorithm>

namespace periporo {

namespace {

/// S_r = S1 + (S2 - S1) [1 + (s/s_a)^n]^-m with s_a = s_a0 (e0/e)^psi and the void ratio e = phi/(1 - phi). This is
/// [1 + (k (v - 1)^psi s)^n]^-m of the specific volume v = 1 + e (Gallipoli, Wheeler and Karstunen 2003, k their phi)
/// with k = 1/(s_a0 e0^psi). Soil without voids is saturated, unless psi = 0.
class VanGenuchtenPorosity : public Retention {
public:
    static std::vector<Parameter> parameters()
    {
        std::vector<Parameter> records{
            Parameter::real("air_entry", dimension::pressure,
                            "Suction s_a0 about which air enters at the reference porosity")
                .above(0.0),
            Parameter::real("reference_porosity", dimension::none, "Porosity phi0 at which air_entry holds")
                .above(0.0)
                .below(1.0),
            Parameter::real("void_ratio_exponent", dimension::none,
                            "Power psi of 1/e in the air-entry value; 0 for none")
                .at_least(0.0)};
        VanGenuchtenShape::append_records(records);
        return records;
    }

    /// @throws std::invalid_argument as SaturationRange does.
    explicit VanGenuchtenPorosity(const Parameters& parameters)
        : shape_(parameters), air_entry_(parameters.real("air_entry")),
          reference_void_ratio_(void_ratio(parameters.real("reference_porosity"))),
          void_ratio_exponent_(parameters.real("void_ratio_exponent"))
    {
    }

    double saturation(double suction, double porosity) const override
    {
        const double looseness = std::pow(void_ratio(porosity) / reference_void_ratio_, void_ratio_exponent_);
        return shape_.saturation(suction / air_entry_ * looseness);
    }

private:
    /// 0 where a point is pressed to less than the volume of its grains.
    static double void_ratio(double porosity) { return std::max(porosity, 0.0) / (1.0 - porosity); }

    VanGenuchtenShape shape_;
    double air_entry_;            // s_a0 [Pa]
    double reference_void_ratio_; // e0
    double void_ratio_exponent_;  // psi
};

} // namespace

} // namespace periporo

PERIPORO_PLUGIN(periporo::PluginKind::retention, periporo::VanGenuchtenPorosity, "van_genuchten_porosity",
                "Retention curve after van Genuchten, air entry by void ratio after Gallipoli et al.")
