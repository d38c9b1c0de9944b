// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The parameter records of a plugin: one list that drives parsing, checking, documentation and provenance.
#pragma once

#include "periporo/units.hpp"

#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <variant>
#include <vector>

namespace periporo {

enum class ParameterType { real, integer, boolean, text, real_list, text_list };

/// What a text of a case stands for, beyond itself.
enum class Naming {
    nothing,
    file,     ///< a file; the plugin gets its full path
    geometry, ///< a [geometry.NAME] of the case; see Geometry::set_operands()
    field,    ///< a field of the snapshots of the case, each once
};

/// What a parameter may hold; every real is in SI units.
using ParameterValue =
    std::variant<double, std::int64_t, bool, std::string, std::vector<double>, std::vector<std::string>>;

/// One key that a plugin (or a section of a case file) understands.
///
///     Parameter::real("bulk_modulus", dimension::pressure, "Elastic bulk modulus K").above(0.0)
///     Parameter::real("friction", dimension::none, "Coulomb coefficient of friction").at_least(0.0)
///     Parameter::text("normal", "Direction of the reaction").one_of({"pair", "surface"}).by_default("pair")
///
/// A parameter without a default must be given by the user, unless it is `optional()`.
struct Parameter {
    std::string name;
    ParameterType type = ParameterType::real;
    Dimension dimension;       ///< of a real or of each member of a real_list
    std::string documentation; ///< one line, without the unit
    bool required = true;
    std::optional<ParameterValue> default_value;
    double minimum = -std::numeric_limits<double>::infinity();
    double maximum = std::numeric_limits<double>::infinity();
    bool minimum_excluded = false;
    bool maximum_excluded = false;
    std::size_t list_size = 0;             ///< exact number of members of a list; 0 for any
    Naming naming = Naming::nothing;       ///< what a text, or each text of a list, names
    std::vector<std::string> choices;      ///< the allowed texts; empty for any
    std::vector<std::string> former_names; ///< accepted with a warning

    static Parameter real(std::string name, Dimension dimension, std::string documentation);
    static Parameter integer(std::string name, std::string documentation);
    static Parameter boolean(std::string name, std::string documentation);
    static Parameter text(std::string name, std::string documentation);
    static Parameter real_list(std::string name, Dimension dimension, std::size_t size, std::string documentation);
    static Parameter text_list(std::string name, std::size_t size, std::string documentation);
    /// A text that names an existing file, relative to the case file that it is written in; the value is its full path.
    static Parameter file(std::string name, std::string documentation);
    /// A list of fields of snapshots, for a writer that stores some of them. They are checked before the run.
    static Parameter fields(std::string name, std::string documentation);
    /// A list of names of [geometry.NAME] tables, for a geometry made of others.
    static Parameter geometries(std::string name, std::string documentation);

    Parameter by_default(double value) &&;
    Parameter by_default(std::int64_t value) &&;
    Parameter by_default(int value) &&;
    Parameter by_default(bool value) &&;
    Parameter by_default(const char* value) &&;
    Parameter by_default(std::vector<double> value) &&;
    /// May be left out and then has no value.
    Parameter optional() &&;
    Parameter above(double bound) &&;
    Parameter at_least(double bound) &&;
    Parameter below(double bound) &&;
    Parameter at_most(double bound) &&;
    Parameter one_of(std::vector<std::string> allowed) &&;
    Parameter formerly(std::string former_name) &&;

    /// Why `value` is outside the range or the choices, or an empty text when it is inside.
    std::string objection(const ParameterValue& value) const;
    /// "> 0", "0 .. 1", "pair | surface" or an empty text, for documentation and messages.
    std::string range_text() const;
};

/// The checked values of a list of parameters. Asking for a value marks it as consumed.
/// @note Asking for a name that was not declared, or with another type, throws std::logic_error: a fault of the plugin.
class Parameters {
public:
    Parameters() = default;

    void set(std::string name, ParameterValue value);

    /// True when the user gave the value or it has a default.
    bool has(const std::string& name) const;
    double real(const std::string& name) const;
    std::int64_t integer(const std::string& name) const;
    bool boolean(const std::string& name) const;
    const std::string& text(const std::string& name) const;
    const std::vector<double>& real_list(const std::string& name) const;
    const std::vector<std::string>& text_list(const std::string& name) const;

    const std::map<std::string, ParameterValue>& values() const { return values_; }
    /// Names that were asked for so far, with `has` or for their value.
    const std::set<std::string>& consumed() const { return consumed_; }

private:
    template <class Value>
    const Value& get(const std::string& name, const char* type) const;

    std::map<std::string, ParameterValue> values_;
    mutable std::set<std::string> consumed_;
};

} // namespace periporo
