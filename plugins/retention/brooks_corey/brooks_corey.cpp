// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Retention curve after Brooks and Corey: the plugin retention "brooks_corey".
#include "../common/saturation_range.hpp"
#include "periporo/retention.hpp"

namespace periporo {

namespace {

/// S_r = S1 + (S2 - S1) (s_a/s)^lambda beyond the suction s_a at which air enters, and S2 up to it (Brooks and Corey
/// 1964).
class BrooksCorey : public Retention {
public:
    static std::vector<Parameter> parameters()
    {
        std::vector<Parameter> records{
            Parameter::real("air_entry", dimension::pressure, "Suction s_a at which air enters").above(0.0),
            Parameter::real("pore_size_index", dimension::none, "Power lambda; small when pores are of many sizes")
                .above(0.0)};
        SaturationRange::append_records(records);
        return records;
    }

    /// @throws std::invalid_argument as SaturationRange does.
    explicit BrooksCorey(const Parameters& parameters)
        : range_(parameters), air_entry_(parameters.real("air_entry")),
          pore_size_index_(parameters.real("pore_size_index"))
    {
    }

    double saturation(double suction, double /*porosity*/) const override
    {
        return suction > air_entry_ ? range_.at(std::pow(air_entry_ / suction, pore_size_index_)) : range_.full();
    }

    bool depends_on_porosity() const override { return false; }

private:
    SaturationRange range_;
    double air_entry_;       // s_a [Pa]
    double pore_size_index_; // lambda
};

} // namespace

} // namespace periporo

PERIPORO_PLUGIN(periporo::PluginKind::retention, periporo::BrooksCorey, "brooks_corey",
                "Retention curve after Brooks and Corey")
