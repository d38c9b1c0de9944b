// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Measured curves: interpolation between the rows, units, what is refused in a file.
#include "retention_checks.hpp"

#include "support/case_text.hpp"
#include "support/temporary_folder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <initializer_list>
#include <vector>

using namespace periporo;
using test::retention;

namespace {

const double porosity = 0.4;

struct Row {
    double suction; // [Pa]
    double saturation;
};

std::unique_ptr<Retention> table_of(const std::string& text)
{
    const test::TemporaryFolder folder;
    test::write_file(folder / "curve.csv", text);
    return retention("table", {{"file", (folder / "curve.csv").string()}});
}

std::unique_ptr<Retention> table_of(const std::vector<Row>& rows)
{
    std::string text = "suction,saturation\n";
    for (const Row& row : rows)
        text += fmt::format("{},{}\n", row.suction, row.saturation); // digits that read back as the same double
    return table_of(text);
}

std::string error_of(const std::string& text)
{
    const std::string message = test::message_of_error([&] { table_of(text); });
    test::check_mentions(message, {"retention plugin \"table\"", "curve.csv"});
    return message;
}

/// Level stretches, near jumps, and pieces of very different widths beside each other.
const std::vector<Row> nasty{{0.0, 1.0},      {1.0, 1.0},       {10.0, 0.97},    {11.0, 0.3}, {12.0, 0.3}, {1e5, 0.3},
                             {1.0001e5, 0.2}, {1.0002e5, 0.05}, {3e5, 0.049999}, {1e9, 0.0},  {1e10, 0.0}};

/// Largest difference between a curve and the table of its values at suctions that are evenly spaced over ln s.
double misfit(const Retention& curve, double lowest, double highest, int pieces)
{
    const auto suction = [&](double part) { return lowest * std::pow(highest / lowest, part); };
    std::vector<Row> rows;
    for (int k = 0; k <= pieces; ++k) {
        const double s = suction(static_cast<double>(k) / pieces);
        rows.push_back({s, curve.saturation(s, porosity)});
    }
    const auto interpolated = table_of(rows);
    double largest = 0.0;
    const int samples = 32 * pieces;
    for (int k = 0; k <= samples; ++k) {
        const double s = suction(static_cast<double>(k) / samples);
        largest = std::max(largest, std::abs(interpolated->saturation(s, porosity) - curve.saturation(s, porosity)));
    }
    return largest;
}

} // namespace

TEST_CASE("the rows are reproduced exactly")
{
    const auto curve = table_of(nasty);
    for (const Row& row : nasty)
        CHECK(curve->saturation(row.suction, porosity) == row.saturation);
}

TEST_CASE("below the first row its saturation holds, and beyond the last row that one's")
{
    const auto curve = table_of(std::vector<Row>{{100.0, 0.9}, {1e4, 0.4}, {1e6, 0.1}});
    for (const double suction : {0.0, 1e-9, 99.9})
        CHECK(curve->saturation(suction, porosity) == 0.9);
    for (const double suction : {1.0001e6, 1e12})
        CHECK(curve->saturation(suction, porosity) == 0.1);
}

TEST_CASE("between two rows saturation falls or stays level, and stays between theirs")
{
    const auto curve = table_of(nasty);
    for (std::size_t k = 1; k < nasty.size(); ++k) {
        const Row& before = nasty[k - 1];
        const Row& after = nasty[k];
        double last = before.saturation;
        for (int n = 1; n < 5000; ++n) {
            const double part = n / 5000.0;
            const double suction = before.suction == 0.0
                                       ? part * after.suction
                                       : before.suction * std::pow(after.suction / before.suction, part);
            const double saturation = curve->saturation(suction, porosity);
            REQUIRE(saturation <= last + 1e-15); // some roundings
            REQUIRE(saturation <= before.saturation);
            REQUIRE(saturation >= after.saturation);
            last = saturation;
        }
    }
}

TEST_CASE("rows of the same saturation have exactly that one between them")
{
    const auto curve = table_of(nasty);
    CHECK(curve->saturation(0.3, porosity) == 1.0);
    for (const double suction : {11.5, 50.0, 9.99e4})
        CHECK(curve->saturation(suction, porosity) == 0.3);
    CHECK(curve->saturation(3e9, porosity) == 0.0);
}

TEST_CASE("rows on a line over ln s give that line, however they are spaced")
{
    const auto line = [](double suction) { return 0.9 - 0.05 * std::log(suction / 10.0); };
    std::vector<Row> rows;
    for (const double suction : {10.0, 11.0, 50.0, 60.0, 5e4, 5.1e4, 1e6})
        rows.push_back({suction, line(suction)});
    for (const std::vector<Row>& some : {rows, std::vector<Row>{rows.front(), rows.back()}}) {
        const auto curve = table_of(some);
        for (double suction = 10.0; suction <= 1e6; suction *= 1.01)
            CHECK(curve->saturation(suction, porosity) == doctest::Approx(line(suction)).epsilon(1e-14));
    }
}

TEST_CASE("from a row without suction the curve is linear in s to the next row")
{
    const std::vector<Row> two{{0.0, 0.98}, {200.0, 0.9}};
    const std::vector<Row> four{{0.0, 0.98}, {200.0, 0.9}, {1e3, 0.5}, {1e5, 0.1}};
    for (const std::vector<Row>& rows : {two, four}) {
        const auto curve = table_of(rows);
        for (const double suction : {0.0, 1e-6, 50.0, 100.0, 199.0})
            CHECK(curve->saturation(suction, porosity) == doctest::Approx(0.98 - 4e-4 * suction).epsilon(1e-15));
        CHECK(curve->saturation(200.0, porosity) == 0.9);
    }
}

TEST_CASE("as evenly spaced rows become denser, the curve through them meets van Genuchten's with the third order")
{
    // Over x = ln s let rows be h apart and f1, f2, f3, f4 the derivatives. The secants at a row are f1 -+ h f2/2 +
    // h^2 f3/6, their harmonic mean is f1 + h^2 (f3/6 - f2^2/(4 f1)), and the parabola's slope at an end f1 - h^2 f3/3:
    // off by order h^2. Slopes that are off by a and b change a cubic by h (a t (1 - t)^2 - b t^2 (1 - t)), order h^3;
    // with true slopes it would be off by h^4 f4/384. Halving h leaves an eighth, up to terms of relative order h.
    const auto curve = retention("van_genuchten", {{"air_entry", 3e3}, {"exponent", 2.0}});
    double last = misfit(*curve, 10.0, 1e6, 80);
    CHECK(last < 1e-3);
    for (const int pieces : {160, 320, 640}) {
        const double now = misfit(*curve, 10.0, 1e6, pieces);
        CAPTURE(pieces);
        CHECK(last / now == doctest::Approx(8.0).epsilon(0.1).scale(0.0));
        last = now;
    }
}

TEST_CASE("suction and saturation may have units, and are taken in theirs")
{
    const auto curve = table_of("# drying\nsaturation [%], suction [kPa]\n100, 0.5\n50, 20 # after a day\n0, 1e3\n");
    for (const auto& [suction, saturation] : {Row{500.0, 1.0}, Row{20e3, 0.5}, Row{1e6, 0.0}})
        CHECK(curve->saturation(suction, porosity) == doctest::Approx(saturation).epsilon(1e-15));
    CHECK(curve->saturation(1e4, porosity) < 1.0);
}

TEST_CASE("the porosity does not matter, and the curve says so")
{
    const auto curve = table_of(nasty);
    CHECK_FALSE(curve->depends_on_porosity());
    CHECK(curve->saturation(5.0, 0.1) == curve->saturation(5.0, 0.9));
}

TEST_CASE("a header or a cell that cannot be read is refused with its line")
{
    test::check_mentions(error_of(""), {"no header"});
    test::check_mentions(error_of("suction,saturatoin\n1,1\n2,0\n"), {"line 1", "saturation"});
    test::check_mentions(error_of("suction [cm],saturation\n1,1\n2,0\n"), {"line 1", "suction is in cm", "kPa"});
    test::check_mentions(error_of("suction,saturation\n1,1\n2,half\n"), {"line 3", "saturation is \"half\""});
}

TEST_CASE("a row that belongs to no retention curve is refused with its line, its value and what is expected")
{
    const auto check_row = [](const std::string& row, std::initializer_list<std::string> parts) {
        const std::string message = error_of("suction [kPa],saturation\n\n1,0.9\n" + row + "\n100,0\n");
        test::check_mentions(message, {"line 4: "});
        test::check_mentions(message, parts);
    };
    check_row("-2,0.5", {"suction is -2000 Pa", "at least 0"});
    check_row("1,0.5", {"suction is 1000 Pa after 1000 Pa", "must rise"});
    check_row("0.5,0.5", {"suction is 500 Pa after 1000 Pa", "must rise"});
    check_row("2,-0.1", {"saturation is -0.1", "0..1"});
    check_row("2,1.1", {"saturation is 1.1", "0..1"});
    check_row("2,0.95", {"saturation is 0.95 after 0.9", "must not rise"});
    test::check_mentions(error_of("suction,saturation [%]\n1,120\n"), {"line 2", "saturation is 1.2;", "0..1"});
    test::check_mentions(error_of("suction,saturation\n0,1\n0,0.9\n"), {"line 3", "suction is 0 Pa after 0 Pa"});
}

TEST_CASE("fewer than two rows make no curve")
{
    test::check_mentions(error_of("suction,saturation\n"), {"no row", "two rows or more"});
    test::check_mentions(error_of("suction,saturation\n1,1\n"), {"one row", "two rows or more"});
}

TEST_CASE("a file that cannot be read is named")
{
    const test::TemporaryFolder folder;
    for (const auto& file : {folder / "no.csv", folder.path()})
        test::check_mentions(test::message_of_error([&] {
                                 retention("table", {{"file", file.string()}});
                             }),
                             {"retention plugin \"table\"", file.string() + ": cannot be read"});
}
