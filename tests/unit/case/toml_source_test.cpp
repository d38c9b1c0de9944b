// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// TOML text to the tree of a case.
#include "case/toml_source.hpp"
#include "unit/case/case_support.hpp"

using namespace periporo;
using namespace periporo::test;

namespace {

CaseNode tree_of(const std::string& text)
{
    const TemporaryFolder folder;
    write_file(folder / "case.toml", text);
    Diagnostics diagnostics;
    return read_toml_files(folder / "case.toml", diagnostics);
}

LineColumn at(const Place& place)
{
    return {place.line, place.column};
}

} // namespace

TEST_CASE("tables keep the order they were written in, not that of the alphabet")
{
    const CaseNode root = tree_of("[zebra]\n[ape]\n[mouse]\n");
    std::vector<std::string> keys;
    for (const CaseEntry& entry : *root.table())
        keys.push_back(entry.key);
    CHECK(keys == std::vector<std::string>{"zebra", "ape", "mouse"});
}

TEST_CASE("keys, values and members of lists know their places")
{
    const std::string text = "a = 1\n[b]\n  c = [ 10, \"x\" ]\n";
    const CaseNode root = tree_of(text);
    const CaseEntry* c = root.find("b")->node.find("c");
    CHECK(at(c->place) == place_in(text, "c ="));
    CHECK(at(c->node.place) == place_in(text, "[ 10"));
    CHECK(at((*c->node.array())[1].place) == place_in(text, "\"x\""));
}

TEST_CASE("a syntax error is one error with its place")
{
    const std::string text = minimal_case + "broken = [1, 2\n";
    const CaseDiagnostic error = error_of(text);
    CHECK(error.line >= place_in(text, "broken").line);
}

TEST_CASE("a key given twice is an error at the second one")
{
    const CaseDiagnostic error = error_of(with(minimal_case, "porosity = 0.2", "porosity = 0.2\nporosity = 0.3"));
    CHECK(contains(error.message, "porosity"));
    CHECK(error.line == place_in(minimal_case, "porosity").line + 1);
}

TEST_CASE("a file that does not exist is an error of the file as a whole")
{
    PluginRegistry registry;
    try {
        read_case("/nowhere/case.toml", {}, registry);
        FAIL("read a case that is not there");
    } catch (const CaseError& error) {
        REQUIRE(error.diagnostics().size() == 1);
        CHECK(error.diagnostics()[0].line == 0);
        CHECK(contains(error.diagnostics()[0].message, "no such file"));
    }
}

TEST_CASE("a value alone is read as TOML, and nothing else is")
{
    const auto source = std::make_shared<CaseSource>();
    CHECK(std::get<double>(parse_toml_value("0.5", source)->value) == 0.5);
    CHECK(parse_toml_value("[1, 2]", source)->array()->size() == 2);
    CHECK_FALSE(parse_toml_value("sand", source).has_value());
    CHECK_FALSE(parse_toml_value("1\nother = 2", source).has_value());
}

TEST_CASE("keys of thousands of parts are an error at their place, however they are written")
{
    const auto dotted = [](const std::string& part, int count) {
        std::string key = part;
        for (int n = 1; n < count; ++n)
            key += "." + part;
        return key;
    };
    for (const std::string& text : {"a = 1\n" + dotted("b", 30000) + " = 1\n", "\n[" + dotted("b", 30000) + "]\n",
                                    "\n" + dotted("\"a.b\"", 30000) + " = 1\n",
                                    "\nb = { x = \"\"\"it's\"\"\", " + dotted("'c'", 30000) + " = 1 }\n"}) {
        const TemporaryFolder folder;
        write_file(folder / "case.toml", text);
        Diagnostics diagnostics;
        try {
            read_toml_files(folder / "case.toml", diagnostics);
            FAIL("no error");
        } catch (const CaseError& error) {
            REQUIRE(error.diagnostics().size() == 1);
            CHECK(error.diagnostics()[0].line == 2);
            CHECK(error.diagnostics()[0].message == "a key has more than 32 parts");
            CHECK(error.diagnostics()[0].hint != "");
        }
    }
}

TEST_CASE("dots in texts, comments and numbers are no parts of keys")
{
    const std::string dots(100, '.');
    const CaseNode root = tree_of("a = \"" + dots + "\" # " + dots + "\nb = [ 0.1, 0.2 ]\nc = \"\"\"\n" + dots +
                                  "\n\"\"\"\nd = '" + dots + "'\n");
    CHECK(root.table()->size() == 4);
}
