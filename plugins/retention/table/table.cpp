// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// A measured retention curve: the plugin retention "table".
#include "monotone_cubic.hpp"
#include "periporo/csv_table.hpp"
#include "periporo/retention.hpp"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace periporo {

namespace {

/// What is wrong with a row, or an empty text.
std::string objection(const CsvTable& table, std::size_t row)
{
    const double suction = table.columns[0][row], saturation = table.columns[1][row];
    if (suction < 0.0)
        return fmt::format("suction is {:.10g} Pa; it must be at least 0", suction);
    if (saturation < 0.0 || saturation > 1.0)
        return fmt::format("saturation is {:.10g}; it must lie in 0..1", saturation);
    if (row == 0)
        return {};
    const double last_suction = table.columns[0][row - 1], last_saturation = table.columns[1][row - 1];
    if (!(std::log(suction) > std::log(last_suction))) // as the curve sees them
        return fmt::format("suction is {:.10g} Pa after {:.10g} Pa in the row before; it must rise from row to row",
                           suction, last_suction);
    if (saturation > last_saturation)
        return fmt::format("saturation is {:.10g} after {:.10g} in the row before; it must not rise with suction",
                           saturation, last_saturation);
    return {};
}

/// Suction and saturation from the file, two rows or more.
/// @throws std::runtime_error that names the file, and the line of the first row that belongs to no retention curve.
CsvTable read_curve(const std::string& file)
{
    CsvTable table = read_csv_table(file, {{"suction", dimension::pressure}, {"saturation", dimension::none}});
    for (std::size_t row = 0; row < table.rows(); ++row)
        if (const std::string fault = objection(table, row); !fault.empty())
            throw std::runtime_error(fmt::format("{}: {}", table.place(row), fault));
    if (table.rows() < 2)
        throw std::runtime_error(fmt::format("{}: has {} below its header; a curve needs two rows or more", file,
                                             table.rows() == 0 ? "no row" : "one row"));
    return table;
}

/// S_r through the rows of a file, by a monotone cubic over ln s; linear in s from a row without suction to the next.
/// Below the first row its saturation, beyond the last row that one's.
class Table : public Retention {
public:
    static std::vector<Parameter> parameters()
    {
        return {Parameter::file("file", "CSV file with the columns suction and saturation, units in its header")};
    }

    /// @throws std::runtime_error as read_curve() does.
    explicit Table(const Parameters& parameters) : Table(read_curve(parameters.text("file"))) {}

    double saturation(double suction, double /*porosity*/) const override
    {
        if (suction >= first_logarithmic_.suction)
            return curve_(std::log(suction));
        // the saturation of the first row where that has a suction itself
        return std::lerp(first_saturation_, first_logarithmic_.saturation, suction / first_logarithmic_.suction);
    }

    bool depends_on_porosity() const override { return false; }

private:
    struct Row {
        double suction; // [Pa]
        double saturation;
    };

    explicit Table(const CsvTable& table)
        : first_saturation_(table.columns[1][0]), first_logarithmic_(row(table, logarithmic_from(table))),
          curve_(over_logarithms(table))
    {
    }

    static Row row(const CsvTable& table, std::size_t n) { return {table.columns[0][n], table.columns[1][n]}; }

    /// The first row with a suction.
    static std::size_t logarithmic_from(const CsvTable& table) { return table.columns[0][0] > 0.0 ? 0 : 1; }

    static MonotoneCubic over_logarithms(const CsvTable& table)
    {
        std::vector<double> logarithms, saturations;
        for (std::size_t n = logarithmic_from(table); n < table.rows(); ++n) {
            logarithms.push_back(std::log(table.columns[0][n]));
            saturations.push_back(table.columns[1][n]);
        }
        return {std::move(logarithms), std::move(saturations)};
    }

    double first_saturation_;
    Row first_logarithmic_;
    MonotoneCubic curve_;
};

} // namespace

} // namespace periporo

PERIPORO_PLUGIN(periporo::PluginKind::retention, periporo::Table, "table", "Measured retention curve from a CSV file")
