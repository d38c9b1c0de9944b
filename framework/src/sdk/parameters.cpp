// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Parameter records, their ranges in words, and the checked values.
#include "periporo/parameters.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace periporo {
namespace {

Parameter make(std::string name, ParameterType type, std::string documentation)
{
    Parameter parameter;
    parameter.name = std::move(name);
    parameter.type = type;
    parameter.documentation = std::move(documentation);
    return parameter;
}

void expect_type(const Parameter& parameter, ParameterType type)
{
    if (parameter.type != type)
        throw std::logic_error(fmt::format("the default of parameter '{}' is of another type", parameter.name));
}

Parameter with_default(Parameter&& parameter, ParameterValue value)
{
    parameter.default_value = std::move(value);
    parameter.required = false;
    return std::move(parameter);
}

bool inside(const Parameter& parameter, double value)
{
    const bool above = parameter.minimum_excluded ? value > parameter.minimum : value >= parameter.minimum;
    const bool below = parameter.maximum_excluded ? value < parameter.maximum : value <= parameter.maximum;
    return above && below; // false for a value that is not a number
}

std::string with_unit(double value, const Dimension& dimension)
{
    return dimension == dimension::none ? fmt::format("{:g}", value)
                                        : fmt::format("{:g} {}", value, si_unit(dimension));
}

std::string objection_to_number(const Parameter& parameter, double value)
{
    if (!std::isfinite(value))
        return fmt::format("must be finite, not {}", value);
    if (inside(parameter, value))
        return {};
    return fmt::format("must be {}, not {}", parameter.range_text(), with_unit(value, parameter.dimension));
}

std::string objection_to_text(const Parameter& parameter, const std::string& value)
{
    const std::vector<std::string>& choices = parameter.choices;
    if (choices.empty() || std::find(choices.begin(), choices.end(), value) != choices.end())
        return {};
    return fmt::format("must be one of {}, not \"{}\"", parameter.range_text(), value);
}

/// First objection to a member of a list, after one to its length.
template <class Member, class Check>
std::string objection_to_list(const Parameter& parameter, const std::vector<Member>& list, Check check)
{
    if (parameter.list_size != 0 && list.size() != parameter.list_size)
        return fmt::format("must have {} members, not {}", parameter.list_size, list.size());
    for (const Member& member : list)
        if (std::string objection = check(parameter, member); !objection.empty())
            return objection;
    return {};
}

} // namespace

Parameter Parameter::real(std::string name, Dimension dimension, std::string documentation)
{
    Parameter parameter = make(std::move(name), ParameterType::real, std::move(documentation));
    parameter.dimension = dimension;
    return parameter;
}

Parameter Parameter::integer(std::string name, std::string documentation)
{
    return make(std::move(name), ParameterType::integer, std::move(documentation));
}

Parameter Parameter::boolean(std::string name, std::string documentation)
{
    return make(std::move(name), ParameterType::boolean, std::move(documentation));
}

Parameter Parameter::text(std::string name, std::string documentation)
{
    return make(std::move(name), ParameterType::text, std::move(documentation));
}

Parameter Parameter::real_list(std::string name, Dimension dimension, std::size_t size, std::string documentation)
{
    Parameter parameter = make(std::move(name), ParameterType::real_list, std::move(documentation));
    parameter.dimension = dimension;
    parameter.list_size = size;
    return parameter;
}

Parameter Parameter::text_list(std::string name, std::size_t size, std::string documentation)
{
    Parameter parameter = make(std::move(name), ParameterType::text_list, std::move(documentation));
    parameter.list_size = size;
    return parameter;
}

Parameter Parameter::file(std::string name, std::string documentation)
{
    Parameter parameter = text(std::move(name), std::move(documentation));
    parameter.naming = Naming::file;
    return parameter;
}

Parameter Parameter::fields(std::string name, std::string documentation)
{
    Parameter parameter = text_list(std::move(name), 0, std::move(documentation));
    parameter.naming = Naming::field;
    return parameter;
}

Parameter Parameter::geometries(std::string name, std::string documentation)
{
    Parameter parameter = text_list(std::move(name), 0, std::move(documentation));
    parameter.naming = Naming::geometry;
    return parameter;
}

Parameter Parameter::by_default(double value) &&
{
    expect_type(*this, ParameterType::real);
    return with_default(std::move(*this), value);
}

Parameter Parameter::by_default(std::int64_t value) &&
{
    if (type == ParameterType::real)
        return with_default(std::move(*this), static_cast<double>(value));
    expect_type(*this, ParameterType::integer);
    return with_default(std::move(*this), value);
}

Parameter Parameter::by_default(int value) &&
{
    return std::move(*this).by_default(std::int64_t{value});
}

Parameter Parameter::by_default(bool value) &&
{
    expect_type(*this, ParameterType::boolean);
    return with_default(std::move(*this), value);
}

Parameter Parameter::by_default(const char* value) &&
{
    expect_type(*this, ParameterType::text);
    return with_default(std::move(*this), std::string(value));
}

Parameter Parameter::by_default(std::vector<double> value) &&
{
    expect_type(*this, ParameterType::real_list);
    return with_default(std::move(*this), std::move(value));
}

Parameter Parameter::optional() &&
{
    required = false;
    default_value.reset();
    return std::move(*this);
}

Parameter Parameter::above(double bound) &&
{
    minimum = bound;
    minimum_excluded = true;
    return std::move(*this);
}

Parameter Parameter::at_least(double bound) &&
{
    minimum = bound;
    minimum_excluded = false;
    return std::move(*this);
}

Parameter Parameter::below(double bound) &&
{
    maximum = bound;
    maximum_excluded = true;
    return std::move(*this);
}

Parameter Parameter::at_most(double bound) &&
{
    maximum = bound;
    maximum_excluded = false;
    return std::move(*this);
}

Parameter Parameter::one_of(std::vector<std::string> allowed) &&
{
    choices = std::move(allowed);
    return std::move(*this);
}

Parameter Parameter::formerly(std::string former_name) &&
{
    former_names.push_back(std::move(former_name));
    return std::move(*this);
}

std::string Parameter::objection(const ParameterValue& value) const
{
    if (const auto* number = std::get_if<double>(&value))
        return objection_to_number(*this, *number);
    if (const auto* whole = std::get_if<std::int64_t>(&value))
        return objection_to_number(*this, static_cast<double>(*whole));
    if (const auto* text = std::get_if<std::string>(&value))
        return objection_to_text(*this, *text);
    if (const auto* numbers = std::get_if<std::vector<double>>(&value))
        return objection_to_list(*this, *numbers, objection_to_number);
    if (const auto* texts = std::get_if<std::vector<std::string>>(&value))
        return objection_to_list(*this, *texts, objection_to_text);
    return {};
}

std::string Parameter::range_text() const
{
    if (!choices.empty())
        return fmt::format("{}", fmt::join(choices, " | "));
    const bool from = std::isfinite(minimum);
    const bool to = std::isfinite(maximum);
    if (from && to && !minimum_excluded && !maximum_excluded)
        return fmt::format("{:g} .. {}", minimum, with_unit(maximum, dimension));
    std::string text;
    if (from)
        text = fmt::format(
            "{} {}", minimum_excluded ? ">" : ">=", minimum == 0.0 ? std::string("0") : with_unit(minimum, dimension));
    if (to)
        text += fmt::format("{}{} {}", from ? " and " : "", maximum_excluded ? "<" : "<=",
                            maximum == 0.0 ? std::string("0") : with_unit(maximum, dimension));
    return text;
}

void Parameters::set(std::string name, ParameterValue value)
{
    values_.insert_or_assign(std::move(name), std::move(value));
}

bool Parameters::has(const std::string& name) const
{
    consumed_.insert(name);
    return values_.contains(name);
}

template <class Value>
const Value& Parameters::get(const std::string& name, const char* type) const
{
    consumed_.insert(name);
    const auto found = values_.find(name);
    if (found == values_.end())
        throw std::logic_error(fmt::format("parameter '{}' has no value: it is not declared, or is optional", name));
    const auto* value = std::get_if<Value>(&found->second);
    if (value == nullptr)
        throw std::logic_error(fmt::format("parameter '{}' is not a {}", name, type));
    return *value;
}

double Parameters::real(const std::string& name) const
{
    return get<double>(name, "real");
}

std::int64_t Parameters::integer(const std::string& name) const
{
    return get<std::int64_t>(name, "whole number");
}

bool Parameters::boolean(const std::string& name) const
{
    return get<bool>(name, "boolean");
}

const std::string& Parameters::text(const std::string& name) const
{
    return get<std::string>(name, "text");
}

const std::vector<double>& Parameters::real_list(const std::string& name) const
{
    return get<std::vector<double>>(name, "list of reals");
}

const std::vector<std::string>& Parameters::text_list(const std::string& name) const
{
    return get<std::vector<std::string>>(name, "list of texts");
}

} // namespace periporo
