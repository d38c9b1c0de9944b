// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// No key of a path is declared and then forgotten.
#include "case/toml_source.hpp"
#include "drive/build_path.hpp"
#include "drive/path_schema.hpp"
#include "support/paths.hpp"

#include <algorithm>
#include <set>

using namespace periporo;
using namespace periporo::test;

namespace {

/// A path with a stage of every kind. What may be a stress or a strain is a strain: the stress is asked for first.
std::string every_kind(const std::string& material, const std::string& start, const std::string& time)
{
    return silt + material + "[plugins]\npaths = [\"more_plugins\"]\n[initial]\n" + start +
           "\n[[stage]]\ntype = \"isotropic\"\nvolumetric_compression = 0.1\n" + time +
           "\n[[stage]]\ntype = \"oedometric\"\naxial_compression = 0.1\n" + time +
           "\n[[stage]]\ntype = \"triaxial_drained\"\naxial_compression = 0.1\n" + time +
           "\n[[stage]]\ntype = \"triaxial_undrained\"\naxial_compression = 0.1\n" + time +
           "\n[[stage]]\ntype = \"simple_shear\"\nshear_strain = 0.1\nvertical = \"constant_height\"\n" + time + R"(
[[stage]]
name = "a"
type = "true_triaxial"
compressions = [0.1, 0.1, 0.1]
duration = 1
[[stage]]
type = "suction"
saturation = 0.4
held = "total_stress"
duration = 1
[[stage]]
type = "mixed"
held_stress = ["xx"]
strain = { yy = 0.1 }
stress = { zz = "-1 kPa" }
duration = 1
)";
}

/// Keys of a table and those below it, by place in the file: "stage.strain.xx". A stage also counts its type, as keys
/// of one name mean different things there.
using Keys = std::set<std::string>;

void collect_declared(const TableRules& rules, const std::string& path, Keys& keys)
{
    for (const Parameter& parameter : rules.parameters)
        keys.insert(path + parameter.name);
    for (const TableVariant& variant : rules.variants)
        collect_declared(variant.rules, path + variant.choice + ".", keys);
    for (const NestedRules& nested : rules.nested)
        collect_declared(nested.rules, path + nested.name + ".", keys);
}

void collect_consumed(const CheckedTable& table, const TableRules& rules, const std::string& path, Keys& keys)
{
    const auto common = [&](const std::string& key) {
        return std::any_of(rules.parameters.begin(), rules.parameters.end(),
                           [&](const Parameter& parameter) { return parameter.name == key; });
    };
    const std::string variant = rules.variants.empty() ? "" : table.own.text(rules.selector) + ".";
    for (const std::string& key : table.own.consumed())
        keys.insert(path + (common(key) ? "" : variant) + key);
    for (const NestedRules& nested : table.nested)
        for (const CheckedTable& below : table.all(nested.name))
            collect_consumed(below, nested.rules, path + variant + nested.name + ".", keys);
}

} // namespace

TEST_CASE("building the description of a path consumes exactly the keys that its rules declare")
{
    const TableRules rules = path_rules(ViscoplasticCriticalState::state_variables());
    Keys consumed;
    for (const std::string& text :
         {every_kind("", "pressure = \"100 kPa\"\nsuction = 0\nsaturation = 0", "duration = 1"),
          every_kind("porosity = 0.4\nretention = { curve = \"hyperbola\", half = 1e3 }\n",
                     "stress = [-1e5, -1e5, -1e5, 0, 0, 0]", "strain_rate = 1")}) {
        const TemporaryFolder folder;
        write_file(folder / "path.toml", text);
        Diagnostics diagnostics;
        const CaseNode root = read_toml_files(folder / "path.toml", diagnostics);
        const CheckedTable checked = check_case(root, rules, path_registry(), diagnostics);
        diagnostics.raise();
        build_path(checked);
        collect_consumed(checked, rules, "", consumed);
    }
    Keys declared;
    collect_declared(rules, "", declared);
    CHECK(consumed == declared);
}
