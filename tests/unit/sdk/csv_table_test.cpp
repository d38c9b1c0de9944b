// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Tables of numbers in text files.
#include "periporo/csv_table.hpp"
#include "support/case_text.hpp"
#include "support/errors.hpp"
#include "support/temporary_folder.hpp"

#include <doctest/doctest.h>

using namespace periporo;
using namespace periporo::test;

namespace {

const std::vector<CsvColumn> wanted{{"suction", dimension::pressure}, {"saturation", dimension::none}};

CsvTable read(const std::string& text)
{
    const TemporaryFolder folder;
    write_file(folder / "table.csv", text);
    return read_csv_table(folder / "table.csv", wanted);
}

std::string fault_of(const std::string& text)
{
    return message_of_error([&] { read(text); });
}

} // namespace

TEST_CASE("columns are found by name, in any order, and come in SI")
{
    const CsvTable table =
        read("\xef\xbb\xbf# a probe\n\"note\", saturation, suction [kPa]\r\n7, +0.9, 1.5 # wet\n\n8, 1e-1, 2\n");
    REQUIRE(table.rows() == 2);
    CHECK(table.columns[0] == std::vector<double>{1500.0, 2000.0});
    CHECK(table.columns[1] == std::vector<double>{0.9, 0.1});
    CHECK(table.lines == std::vector<std::size_t>{3, 5});
    CHECK(contains(table.place(1), "table.csv: line 5"));
}

TEST_CASE("columns without a unit are in SI, and \"-\" is that of a pure number")
{
    const CsvTable table = read("suction, saturation [-]\n3, 0.5\n");
    CHECK(table.columns[0].at(0) == 3.0);
    CHECK(table.columns[1].at(0) == 0.5);
}

TEST_CASE("a fault names the file, the line and the column")
{
    check_mentions(fault_of("suction\n1\n"), {"table.csv: line 1", "no column saturation [-]"});
    check_mentions(fault_of("suction, suction, saturation\n"), {"line 1", "two columns are named suction"});
    check_mentions(fault_of("suction [m], saturation\n"), {"line 1", "suction is in m", "kPa"});
    check_mentions(fault_of("suction [kPaa], saturation\n"), {"line 1", "kPaa"});
    check_mentions(fault_of("suction, saturation\n1, 0.5\n2\n"), {"line 3", "1 cells, and 2 in the header"});
    for (const std::string cell : {"", "many", "nan", "inf", "1 kPa", "1e999"})
        check_mentions(fault_of("suction, saturation\n" + cell + ", 0.5\n"), {"line 2", "suction is \"" + cell + "\""});
    check_mentions(fault_of("# nothing\n\n"), {"table.csv", "no header"});
    check_mentions(message_of_error([] { read_csv_table("/nowhere/table.csv", wanted); }),
                   {"/nowhere/table.csv", "cannot be read"});
}

TEST_CASE("what was passed over is named")
{
    CHECK(read("note, suction, saturation, \"probe [m]\"\n1, 2, 0.5, 3\n").unused ==
          std::vector<std::string>{"note", "probe"});
}
