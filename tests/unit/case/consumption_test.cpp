// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// No key of a case is declared and then forgotten.
#include "case/build_description.hpp"
#include "case/checker.hpp"
#include "case/toml_source.hpp"
#include "unit/case/case_support.hpp"

#include <set>

using namespace periporo;
using namespace periporo::test;

namespace {

/// "stage.until.residual" for every parameter that the rules know, variants included.
void collect_declared(const TableRules& rules, const std::string& path, std::set<std::string>& keys)
{
    for (const Parameter& parameter : rules.parameters)
        keys.insert(path + parameter.name);
    for (const TableVariant& variant : rules.variants)
        collect_declared(variant.rules, path, keys);
    for (const NestedRules& nested : rules.nested)
        collect_declared(nested.rules, path + nested.name + ".", keys);
}

void collect_consumed(const CheckedTable& table, const std::string& path, std::set<std::string>& keys)
{
    for (const std::string& key : table.own.consumed())
        keys.insert(path + key);
    for (const auto& [name, tables] : table.tables)
        for (const CheckedTable& nested : tables)
            collect_consumed(nested, path + name + ".", keys);
}

CheckedTable check_full_case(const std::string& water = "")
{
    const TemporaryFolder folder;
    write_file(folder / "suction.csv", "x, y, z, suction\n0, 0, 0, 1\n");
    const std::string uniform = "water = { type = \"uniform\", suction = \"20 kPa\", saturation = 0.3 }";
    write_file(folder / "case.toml", water.empty() ? full_case : with(full_case, uniform, water));
    Diagnostics diagnostics;
    const CaseNode root = read_toml_files(folder / "case.toml", diagnostics);
    CheckedTable checked = check_case(root, test_registry(), diagnostics);
    diagnostics.raise();
    return checked;
}

} // namespace

TEST_CASE("building the description consumes exactly the keys that the framework declares")
{
    const CheckedTable checked = check_full_case();
    std::set<std::string> before;
    collect_consumed(checked, "", before);
    CHECK(before.empty());

    std::set<std::string> declared;
    collect_declared(case_rules(), "", declared);
    std::set<std::string> consumed;
    for (const std::string water :
         {"", "water = { type = \"hydrostatic\", water_table = \"z = 0\", largest_suction = 1, saturation = 0.3 }",
          "water = { type = \"field\", file = \"suction.csv\", saturation = 0.3 }"}) {
        const CheckedTable with_water = check_full_case(water);
        build_description(with_water);
        collect_consumed(with_water, "", consumed);
    }
    // read by the same routine as those of a body
    for (const char* key : {"file", "largest_suction", "water_table"})
        declared.erase(std::string("stage.water.") + key);
    CHECK(consumed == declared);
}

TEST_CASE("every default of the framework is inside of its own range")
{
    const auto check = [](const auto& self, const TableRules& rules) -> void {
        for (const Parameter& parameter : rules.parameters)
            if (parameter.default_value) {
                CAPTURE(parameter.name);
                CHECK(parameter.objection(*parameter.default_value).empty());
            }
        for (const TableVariant& variant : rules.variants)
            self(self, variant.rules);
        for (const NestedRules& nested : rules.nested)
            self(self, nested.rules);
    };
    check(check, case_rules());
}

TEST_CASE("reading a case consumes nothing of the plugins' parameters")
{
    const CaseDescription read = read_text(full_case);
    CHECK(read.bodies[0].geometry.parameters.consumed().empty());
    CHECK(read.materials[0].model.parameters.consumed().empty());
}
