// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Retention curve after van Genuchten: the plugin retention "van_genuchten".
#include "../common/van_genuchten_shape.hpp"
#include "periporo/retention.hpp"

namespace periporo {

namespace {

/// S_r = S1 + (S2 - S1) [1 + (s/s_a)^n]^-m (van Genuchten 1980).
class VanGenuchten : public Retention {
public:
    static std::vector<Parameter> parameters()
    {
        std::vector<Parameter> records{
            Parameter::real("air_entry", dimension::pressure, "Suction s_a about which air enters").above(0.0)};
        VanGenuchtenShape::append_records(records);
        return records;
    }

    /// @throws std::invalid_argument as SaturationRange does.
    explicit VanGenuchten(const Parameters& parameters) : shape_(parameters), air_entry_(parameters.real("air_entry"))
    {
    }

    double saturation(double suction, double /*porosity*/) const override
    {
        return shape_.saturation(suction / air_entry_);
    }

    bool depends_on_porosity() const override { return false; }

private:
    VanGenuchtenShape shape_;
    double air_entry_; // s_a [Pa]
};

} // namespace

} // namespace periporo

PERIPORO_PLUGIN(periporo::PluginKind::retention, periporo::VanGenuchten, "van_genuchten",
                "Retention curve after van Genuchten")
