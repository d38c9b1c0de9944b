// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Checks type, unit and range of one value.
#include "case/value.hpp"

#include "sdk/nearest_name.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <stdexcept>
#include <system_error>
#include <utility>

namespace periporo {
namespace {

std::string quantity_hint(const Parameter& parameter)
{
    if (parameter.dimension == dimension::none)
        return "units: " + known_units(parameter.dimension);
    return fmt::format("units: {}; a number without quotes is in {}", known_units(parameter.dimension),
                       si_unit(parameter.dimension));
}

/// Reads members and remembers what was wrong with them.
class ValueReader {
public:
    ValueReader(const Parameter& parameter, Diagnostics& diagnostics) : parameter_(parameter), diagnostics_(diagnostics)
    {
    }

    std::optional<double> real(const CaseNode& node)
    {
        const std::optional<double> value = plain_real(node);
        if (value)
            warn_of_small_modulus(node, *value);
        return value;
    }

    std::optional<std::int64_t> integer(const CaseNode& node)
    {
        if (const auto* whole = std::get_if<std::int64_t>(&node.value))
            return *whole;
        return wrong_type<std::int64_t>(node, "a whole number", {});
    }

    std::optional<bool> boolean(const CaseNode& node)
    {
        if (const auto* value = std::get_if<bool>(&node.value))
            return *value;
        return wrong_type<bool>(node, "true or false", {});
    }

    std::optional<std::string> text(const CaseNode& node)
    {
        if (node.text() != nullptr)
            return *node.text();
        return wrong_type<std::string>(node, "a text", "write it in double quotes");
    }

    /// @param read one of the member functions above.
    template <class Member, class Read>
    std::optional<std::vector<Member>> list(const CaseNode& node, const char* expected, Read read)
    {
        const CaseNode::Array* array = node.array();
        if (array == nullptr)
            return wrong_type<std::vector<Member>>(node, expected, {});
        std::vector<Member> members;
        bool sound = true;
        for (const CaseNode& item : *array) {
            std::optional<Member> member = (this->*read)(item);
            sound = sound && member.has_value();
            if (member)
                members.push_back(std::move(*member));
        }
        return sound ? std::optional(std::move(members)) : std::nullopt;
    }

private:
    template <class Value>
    std::optional<Value> wrong_type(const CaseNode& node, const char* expected, std::string hint)
    {
        diagnostics_.error(node.place,
                           fmt::format("'{}' must be {}, not {}", parameter_.name, expected, found_text(node)),
                           hint.empty() ? describe(parameter_) : std::move(hint));
        return std::nullopt;
    }

    std::optional<double> plain_real(const CaseNode& node)
    {
        if (const auto* number = std::get_if<double>(&node.value))
            return *number;
        if (const auto* whole = std::get_if<std::int64_t>(&node.value))
            return static_cast<double>(*whole);
        if (node.text() == nullptr)
            return wrong_type<double>(node, "a number or a text with a unit", quantity_hint(parameter_));
        return quantity(node);
    }

    void warn_of_small_modulus(const CaseNode& node, double value)
    {
        constexpr double softest = 1e3; // Pa; gels have some kilopascals
        if (parameter_.dimension == dimension::pressure && parameter_.name.ends_with("modulus") && value > 0.0 &&
            value < softest)
            diagnostics_.warning(node.place, fmt::format("'{}' is {:.4g} Pa, softer than a gel; without quotes a "
                                                         "number is in Pa, and \"MPa\" are millions of them",
                                                         parameter_.name, value));
    }

    void warn_of_unit(const CaseNode& node)
    {
        if (parameter_.dimension == dimension::pressure && node.text()->find("mPa") != std::string::npos)
            diagnostics_.warning(node.place,
                                 fmt::format("'{}': \"{}\" are thousandths of a pascal; \"MPa\" are millions",
                                             parameter_.name, *node.text()));
    }

    std::optional<double> quantity(const CaseNode& node)
    {
        Quantity quantity;
        try {
            quantity = parse_quantity(*node.text());
        } catch (const std::invalid_argument& fault) {
            diagnostics_.error(node.place, fmt::format("'{}': {}", parameter_.name, fault.what()),
                               quantity_hint(parameter_));
            return std::nullopt;
        }
        if (fits(quantity.dimension, parameter_.dimension)) {
            warn_of_unit(node);
            return quantity.value;
        }
        const std::string given = quantity.dimension == dimension::none
                                      ? std::string("has no unit")
                                      : fmt::format("is in units of {}", si_unit(quantity.dimension));
        const std::string expected = parameter_.dimension == dimension::none
                                         ? std::string("a pure number is expected")
                                         : fmt::format("{} is expected", si_unit(parameter_.dimension));
        diagnostics_.error(node.place,
                           fmt::format("'{}': \"{}\" {}, {}", parameter_.name, *node.text(), given, expected),
                           quantity_hint(parameter_));
        return std::nullopt;
    }

    const Parameter& parameter_;
    Diagnostics& diagnostics_;
};

std::optional<ParameterValue> read_type(const CaseNode& node, const Parameter& parameter, Diagnostics& diagnostics)
{
    ValueReader reader(parameter, diagnostics);
    switch (parameter.type) {
    case ParameterType::real:
        return reader.real(node);
    case ParameterType::integer:
        return reader.integer(node);
    case ParameterType::boolean:
        return reader.boolean(node);
    case ParameterType::text:
        return reader.text(node);
    case ParameterType::real_list:
        return reader.list<double>(node, "a list of numbers or texts with units", &ValueReader::real);
    case ParameterType::text_list:
        return reader.list<std::string>(node, "a list of texts", &ValueReader::text);
    }
    return std::nullopt;
}

/// Full path of the file that a text names; nothing, and an error, when there is none.
std::optional<ParameterValue> existing_file(const CaseNode& node, const Parameter& parameter, Diagnostics& diagnostics)
{
    if (node.text()->empty()) {
        diagnostics.error(node.place, fmt::format("'{}' names no file: the text is empty", parameter.name),
                          describe(parameter));
        return std::nullopt;
    }
    const std::filesystem::path& writer = node.place.source->file; // none for an override: the working folder counts
    const std::filesystem::path file =
        std::filesystem::absolute(writer.parent_path() / *node.text()).lexically_normal();
    std::error_code error;
    if (std::filesystem::is_regular_file(file, error))
        return file.string();
    diagnostics.error(node.place, fmt::format("'{}': there is no file {}", parameter.name, file.string()),
                      writer.empty() ? "paths in overrides are relative to the working folder"
                                     : "paths are relative to the file that they are written in");
    return std::nullopt;
}

std::string choice_hint(const CaseNode& node, const Parameter& parameter)
{
    if (node.text() == nullptr || parameter.choices.empty())
        return describe(parameter);
    const std::optional<std::string> nearest = nearest_name(*node.text(), parameter.choices);
    return nearest ? fmt::format("did you mean '{}'?", *nearest) : describe(parameter);
}

} // namespace

std::optional<ParameterValue> read_value(const CaseNode& node, const Parameter& parameter, Diagnostics& diagnostics)
{
    std::optional<ParameterValue> value = read_type(node, parameter, diagnostics);
    if (!value)
        return std::nullopt;
    if (const std::string objection = parameter.objection(*value); !objection.empty()) {
        diagnostics.error(node.place, fmt::format("'{}' {}", parameter.name, objection), choice_hint(node, parameter));
        return std::nullopt;
    }
    return parameter.naming == Naming::file ? existing_file(node, parameter, diagnostics) : value;
}

std::string type_text(const Parameter& parameter)
{
    std::string number = parameter.dimension == dimension::none ? "number" : si_unit(parameter.dimension);
    const std::string times = parameter.list_size == 0 ? "list of " : fmt::format("{} x ", parameter.list_size);
    switch (parameter.type) {
    case ParameterType::real:
        return number;
    case ParameterType::integer:
        return "whole number";
    case ParameterType::boolean:
        return "true or false";
    case ParameterType::text:
        return parameter.naming == Naming::file ? "path of a file" : "text";
    case ParameterType::real_list:
        return times + number;
    case ParameterType::text_list:
        return times + (parameter.naming == Naming::geometry ? "[geometry.NAME]"
                        : parameter.naming == Naming::field  ? "name of a field"
                                                             : "text");
    }
    return {};
}

std::string describe(const Parameter& parameter)
{
    const std::string range = parameter.range_text();
    return fmt::format("{} ({}{}{})", parameter.documentation, type_text(parameter), range.empty() ? "" : ", ", range);
}

} // namespace periporo
