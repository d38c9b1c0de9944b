// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The parameter values that a law is built from, and whether it reads all that it declares.
#pragma once

#include "periporo/kit/range.hpp"
#include "periporo/parameters.hpp"

#include <cstdint>
#include <map>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace periporo::kit {

namespace detail {

/// A whole number is a real too, as in a case file.
inline ParameterValue as_declared(const Parameter& record, ParameterValue value)
{
    if (record.type == ParameterType::real)
        if (const auto* whole = std::get_if<std::int64_t>(&value))
            return static_cast<double>(*whole);
    const std::size_t declared = static_cast<std::size_t>(record.type);
    if (value.index() != declared) {
        static constexpr const char* names[] = {"real", "whole number",  "boolean",
                                                "text", "list of reals", "list of texts"};
        throw std::invalid_argument("parameter '" + record.name + "' must be a " + names[declared] + ", not a " +
                                    names[value.index()]);
    }
    return value;
}

} // namespace detail

/// `given` over the defaults of the records, in SI.
/// @throws std::invalid_argument that names all that is missing, or one value that is unknown, of another type or out
/// of its range.
inline Parameters parameters_of(const std::vector<Parameter>& records, std::map<std::string, ParameterValue> given)
{
    Parameters values;
    std::string missing;
    for (const Parameter& record : records) {
        if (auto found = given.extract(record.name); !found.empty()) {
            ParameterValue value = detail::as_declared(record, std::move(found.mapped()));
            if (const std::string objection = record.objection(value); !objection.empty())
                throw std::invalid_argument("parameter '" + record.name + "' " + objection);
            values.set(record.name, std::move(value));
        } else if (record.default_value) {
            values.set(record.name, *record.default_value);
        } else if (record.required) {
            missing += (missing.empty() ? "'" : ", '") + record.name + "'";
        }
    }
    if (!given.empty())
        throw std::invalid_argument("there is no parameter '" + given.begin()->first + "'");
    if (!missing.empty())
        throw std::invalid_argument("missing parameters: " + missing);
    return values;
}

/// Checks that a constructor asked for every declared parameter and for no other, and that names are unique and
/// documented.
/// @param used the values that the constructor was given, after it.
inline Faults check_parameters(const std::vector<Parameter>& records, const Parameters& used)
{
    Faults faults;
    std::set<std::string> declared;
    for (const Parameter& record : records) {
        if (!declared.insert(record.name).second)
            faults.push_back("parameters: '" + record.name + "' is declared twice");
        if (record.documentation.empty())
            faults.push_back("parameters: '" + record.name + "' has no documentation");
        if (!used.consumed().contains(record.name))
            faults.push_back("parameters: '" + record.name + "' is declared and the constructor never asks for it");
    }
    for (const std::string& name : used.consumed())
        if (!declared.contains(name))
            faults.push_back("parameters: the constructor asks for '" + name + "', which is not declared");
    return faults;
}

} // namespace periporo::kit
