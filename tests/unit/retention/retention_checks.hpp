// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Retention curves of this build, and what each of them must satisfy.
#pragma once

#include "periporo/kit/parameters.hpp"
#include "support/errors.hpp"
#include "support/plugins.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <map>
#include <memory>
#include <string>

namespace periporo::test {

using Given = std::map<std::string, ParameterValue>;

/// A value from a closed form, or from the same operations in another order: some roundings, magnified by powers.
inline doctest::Approx rounded(double value)
{
    return doctest::Approx(value).epsilon(1e-13).scale(0.0);
}

/// `given` with some values changed.
inline Given changed(Given given, const Given& changes)
{
    for (const auto& [name, value] : changes)
        given.insert_or_assign(name, value);
    return given;
}

/// The curve from its library. Its constructor must have asked for every parameter that it declares.
inline std::unique_ptr<Retention> retention(const std::string& name, const Given& given)
{
    const std::vector<Parameter>& records = built_plugins().require(PluginKind::retention, name).parameters;
    const Parameters parameters = kit::parameters_of(records, given);
    std::unique_ptr<Retention> curve = built_plugins().make_retention(name, parameters);
    CHECK(kit::check_parameters(records, parameters) == kit::Faults{});
    return curve;
}

/// Why the record of a parameter refuses a value; empty when it does not.
inline std::string objection(const std::string& name, const std::string& parameter, double value)
{
    for (const Parameter& record : built_plugins().require(PluginKind::retention, name).parameters)
        if (record.name == parameter)
            return record.objection(value);
    FAIL("the curve " << name << " has no parameter " << parameter);
    return {};
}

/// Residual and full saturation are refused beyond 0..1, and unless the first is less.
inline void check_refused_saturations(const std::string& name, const Given& valid)
{
    for (const char* limit : {"residual_saturation", "full_saturation"})
        for (const double beyond : {-0.01, 1.01})
            check_mentions(objection(name, limit, beyond), {"0 .. 1"});
    for (const char* full : {"0.3", "0.4"}) {
        const Given given = changed(valid, {{"residual_saturation", 0.4}, {"full_saturation", std::stod(full)}});
        check_mentions(message_of_error([&] { retention(name, given); }),
                       {"retention plugin \"" + name + "\"",
                        std::string("residual_saturation (0.4) must be less than full_saturation (") + full + ")"});
    }
}

/// Saturation is `full` without suction, falls or stays level over 18 decades, and keeps within `residual` and `full`.
inline void check_falls(const Retention& curve, double porosity, double residual, double full)
{
    CAPTURE(porosity);
    CHECK(curve.saturation(0.0, porosity) == full);
    double last = full;
    for (int n = -600; n <= 1200; ++n) {
        const double suction = std::pow(10.0, 0.01 * n);
        CAPTURE(suction);
        const double saturation = curve.saturation(suction, porosity);
        REQUIRE(std::isfinite(saturation));
        REQUIRE(saturation <= last + 2.3e-16); // two of the last places of a number below 1
        REQUIRE(saturation <= full);
        REQUIRE(saturation >= residual);
        last = saturation;
    }
    CHECK(last < full);
}

} // namespace periporo::test
