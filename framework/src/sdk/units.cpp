// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Reads quantities with units and names the units of a dimension.
#include "periporo/units.hpp"

#include "nearest_name.hpp"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <vector>

namespace periporo {
namespace {

/// A unit as factor x 10^exponent SI units. The power of ten is kept apart so that "5 mm" is 5/1000, rounded once,
/// and not 5 times an already rounded 0.001.
struct Unit {
    double factor = 1.0;
    int exponent = 0;
    Dimension dimension;
};

struct Symbol {
    std::string_view text;
    Unit unit;
    bool takes_prefix;
};

constexpr std::array symbols{
    Symbol{"m", {1.0, 0, dimension::length}, true},
    Symbol{"g", {1.0, -3, dimension::mass}, true},
    Symbol{"s", {1.0, 0, dimension::time}, true},
    Symbol{"N", {1.0, 0, dimension::force}, true},
    Symbol{"Pa", {1.0, 0, dimension::pressure}, true},
    Symbol{"J", {1.0, 0, dimension::energy}, true},
    Symbol{"W", {1.0, 0, {1, 2, -3}}, true},
    Symbol{"Hz", {1.0, 0, {0, 0, -1}}, true},
    Symbol{"t", {1.0, 3, dimension::mass}, false},
    Symbol{"bar", {1.0, 5, dimension::pressure}, false},
    Symbol{"min", {60.0, 0, dimension::time}, false},
    Symbol{"h", {3600.0, 0, dimension::time}, false},
    Symbol{"d", {86400.0, 0, dimension::time}, false},
    Symbol{"rad", {1.0, 0, dimension::angle}, false},
    Symbol{"deg", {std::numbers::pi / 180.0, 0, dimension::angle}, false},
    Symbol{"%", {1.0, -2, dimension::none}, false},
};

struct Prefix {
    char text;
    int exponent;
};
constexpr std::array prefixes{Prefix{'n', -9}, Prefix{'u', -6}, Prefix{'m', -3}, Prefix{'c', -2}, Prefix{'d', -1},
                              Prefix{'h', 2},  Prefix{'k', 3},  Prefix{'M', 6},  Prefix{'G', 9},  Prefix{'T', 12}};

/// What users write most for a dimension; the first one is the SI unit.
struct UsualUnits {
    Dimension dimension;
    std::string_view si;
    std::string_view all;
};
constexpr std::array usual_units{
    UsualUnits{dimension::none, "-", "a pure number, %"},
    UsualUnits{dimension::angle, "rad", "deg, rad"},
    UsualUnits{dimension::angular_velocity, "rad/s", "rad/s, deg/s"},
    UsualUnits{dimension::length, "m", "m, cm, mm, um, km"},
    UsualUnits{dimension::area, "m2", "m2, cm2, mm2"},
    UsualUnits{dimension::volume, "m3", "m3, cm3, mm3"},
    UsualUnits{dimension::time, "s", "s, ms, us, min, h, d"},
    UsualUnits{dimension::mass, "kg", "kg, g, t"},
    UsualUnits{dimension::velocity, "m/s", "m/s, cm/s, mm/s, km/h"},
    UsualUnits{dimension::acceleration, "m/s2", "m/s2, cm/s2, mm/s2"},
    UsualUnits{dimension::density, "kg/m3", "kg/m3, g/cm3, t/m3"},
    UsualUnits{dimension::force, "N", "N, kN, MN"},
    UsualUnits{dimension::energy, "J", "J, kJ, MJ"},
    UsualUnits{dimension::pressure, "Pa", "Pa, kPa, MPa, GPa"},
    UsualUnits{dimension::spring, "N/m", "N/m, kN/m, MN/m"},
    UsualUnits{dimension::pressure_per_length, "Pa/m", "Pa/m, kPa/m, MPa/m, GPa/m, MPa/mm, kN/m3"},
    UsualUnits{dimension::dynamic_viscosity, "Pa s", "Pa s, kPa s, MPa s"},
    UsualUnits{dimension::squared_yield_viscosity, "Pa3 s", "Pa3 s, kPa3 s"},
};

const UsualUnits* find_usual(const Dimension& dimension)
{
    for (const UsualUnits& usual : usual_units)
        if (usual.dimension == dimension)
            return &usual;
    return nullptr;
}

std::optional<Unit> find_symbol(std::string_view text)
{
    for (const Symbol& symbol : symbols)
        if (symbol.text == text)
            return symbol.unit;
    for (const Prefix& prefix : prefixes)
        for (const Symbol& symbol : symbols)
            if (symbol.takes_prefix && text.size() == symbol.text.size() + 1 && text.front() == prefix.text &&
                text.substr(1) == symbol.text) {
                Unit unit = symbol.unit;
                unit.exponent += prefix.exponent;
                return unit;
            }
    return std::nullopt;
}

std::vector<std::string> all_symbols()
{
    std::vector<std::string> names;
    names.reserve(symbols.size() * (prefixes.size() + 1));
    for (const Symbol& symbol : symbols)
        names.emplace_back(symbol.text);
    // Most usual prefixes first: the earlier of equally near names is suggested.
    for (const char prefix : {'k', 'M', 'm', 'c', 'G', 'u', 'n', 'd', 'h', 'T'})
        for (const Symbol& symbol : symbols)
            if (symbol.takes_prefix)
                names.push_back(prefix + std::string(symbol.text));
    return names;
}

/// The few signs outside ASCII that units are written with, as their plain spelling.
std::string plain_spelling(std::string_view text)
{
    struct Spelling {
        std::string_view sign;
        std::string_view plain;
    };
    static constexpr std::array spellings{Spelling{"\u00b2", "2"}, Spelling{"\u00b3", "3"}, Spelling{"\u00b7", "*"},
                                          Spelling{"\u00b5", "u"}, Spelling{"\u03bc", "u"}, Spelling{"\u00b0", "deg"}};
    std::string plain(text);
    for (const Spelling& spelling : spellings)
        for (std::size_t at = plain.find(spelling.sign); at != std::string::npos; at = plain.find(spelling.sign, at))
            plain.replace(at, spelling.sign.size(), spelling.plain);
    return plain;
}

/// Reads the unit of a quantity from left to right.
class UnitParser {
public:
    UnitParser(std::string_view unit, std::string_view whole) : unit_(unit), whole_(whole) {}

    Unit parse()
    {
        Unit product;
        bool divided = false;
        for (bool first = true; skip_spaces(), position_ < unit_.size(); first = false) {
            bool divide = false;
            const char operation = unit_[position_];
            if (operation == '/' || operation == '*') {
                if (first)
                    fail(fmt::format("'{}' stands before any unit", operation));
                divide = operation == '/';
                ++position_;
                skip_spaces();
            }
            if (divided && !divide)
                fail("a product after '/' may be read in two ways; repeat the '/' or use powers, \"kg m^-1 s^-1\"");
            divided = divided || divide;
            multiply(product, divide ? -1 : 1);
        }
        return product;
    }

private:
    void skip_spaces()
    {
        while (position_ < unit_.size() && unit_[position_] == ' ')
            ++position_;
    }

    void multiply(Unit& product, int sign)
    {
        const Unit unit = read_symbol();
        const int power = sign * read_power();
        product.factor *= std::pow(unit.factor, power);
        product.exponent += unit.exponent * power;
        product.dimension.mass += unit.dimension.mass * power;
        product.dimension.length += unit.dimension.length * power;
        product.dimension.time += unit.dimension.time * power;
        product.dimension.angle += unit.dimension.angle * power;
    }

    Unit read_symbol()
    {
        constexpr std::string_view ends = " */^+-0123456789";
        const std::size_t end = std::min(unit_.find_first_of(ends, position_), unit_.size());
        const std::string_view text = unit_.substr(position_, end - position_);
        if (text.empty())
            fail("a unit is missing");
        position_ = end;
        if (const std::optional<Unit> unit = find_symbol(text))
            return *unit;
        const std::optional<std::string> nearest = nearest_name(text, all_symbols());
        fail(fmt::format("unknown unit '{}'{}", text, nearest ? fmt::format(", did you mean '{}'?", *nearest) : ""));
    }

    int read_power()
    {
        const bool caret = position_ < unit_.size() && unit_[position_] == '^';
        if (caret)
            ++position_;
        int power = 1;
        const char* begin = unit_.data() + position_;
        const char* end = unit_.data() + unit_.size();
        if (begin != end && *begin == '+')
            ++begin;
        const auto [after, error] = std::from_chars(begin, end, power);
        if (error != std::errc{}) {
            if (caret || (begin != end && (*begin == '-' || begin[-1] == '+')))
                fail("a power must be a whole number");
            return 1;
        }
        if (power == 0 || std::abs(power) > 9)
            fail("a power must be between -9 and 9 and not 0");
        position_ = static_cast<std::size_t>(after - unit_.data());
        return power;
    }

    [[noreturn]] void fail(const std::string& reason) const
    {
        throw std::invalid_argument(fmt::format("{} in \"{}\"", reason, whole_));
    }

    std::string_view unit_;
    std::string_view whole_;
    std::size_t position_ = 0;
};

std::string_view trimmed(std::string_view text)
{
    const std::size_t begin = text.find_first_not_of(' ');
    if (begin == std::string_view::npos)
        return {};
    return text.substr(begin, text.find_last_not_of(' ') - begin + 1);
}

double scaled(double number, const Unit& unit)
{
    const double power = std::pow(10.0, std::abs(unit.exponent));
    const double shifted = unit.exponent < 0 ? number / power : number * power;
    return shifted * unit.factor;
}

} // namespace

std::string si_unit(const Dimension& dimension)
{
    if (const UsualUnits* usual = find_usual(dimension))
        return std::string(usual->si);
    std::string text;
    const auto append = [&text](std::string_view symbol, int power) {
        if (power == 0)
            return;
        text += fmt::format("{}{}", text.empty() ? "" : " ", symbol);
        if (power != 1)
            text += fmt::format("^{}", power);
    };
    append("kg", dimension.mass);
    append("m", dimension.length);
    append("s", dimension.time);
    append("rad", dimension.angle);
    return text;
}

bool fits(const Dimension& given, const Dimension& wanted)
{
    Dimension as_number = wanted;
    as_number.angle = 0;
    return given == wanted || given == as_number;
}

std::string known_units(const Dimension& dimension)
{
    const UsualUnits* usual = find_usual(dimension);
    return usual ? std::string(usual->all) : si_unit(dimension);
}

Quantity parse_quantity(std::string_view text)
{
    const std::string plain = plain_spelling(trimmed(text));
    const char* begin = plain.data();
    const char* end = begin + plain.size();
    if (begin != end && *begin == '+')
        ++begin;
    // from_chars would also read "inf" and "nan", which are no quantities.
    const char* first = begin != end && *begin == '-' ? begin + 1 : begin;
    double number = 0.0;
    const auto [after, error] = std::from_chars(begin, end, number);
    if (first == end || !(std::isdigit(static_cast<unsigned char>(*first)) || *first == '.') ||
        error == std::errc::invalid_argument)
        throw std::invalid_argument(fmt::format("\"{}\" does not begin with a number", text));
    if (error == std::errc::result_out_of_range)
        throw std::invalid_argument(fmt::format("the number in \"{}\" is too large or too small", text));
    const std::string_view unit_text(after, static_cast<std::size_t>(end - after));
    const Unit unit = UnitParser(unit_text, text).parse();
    const double value = scaled(number, unit);
    if (!std::isfinite(value))
        throw std::invalid_argument(fmt::format("\"{}\" is too large", text));
    return {value, unit.dimension};
}

} // namespace periporo
