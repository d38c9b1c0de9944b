// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The text that a user sees for an error.
#include "unit/case/case_support.hpp"

using namespace periporo;
using namespace periporo::test;

namespace {

std::string text_of(const std::string& text, const std::filesystem::path& file)
{
    write_file(file, text);
    PluginRegistry registry = test_registry();
    try {
        read_case(file, {}, registry);
    } catch (const CaseError& error) {
        return error.what();
    }
    return {};
}

} // namespace

TEST_CASE("an error shows place, message, line, caret and hint, in this order")
{
    const TemporaryFolder folder;
    const std::string file = (folder / "case.toml").string();
    const std::string shown = text_of(with(minimal_case, "porosity = 0.2", "porosity = 1.2"), file);
    CHECK(shown == file + ":7:12: error: 'porosity' must be >= 0 and < 1, not 1.2\n"
                          "     7 | porosity = 1.2\n"
                          "       |            ^\n"
                          "  hint: Initial porosity phi0 (number, >= 0 and < 1)\n");
}

TEST_CASE("the caret stands under the place when tabs and letters of several bytes come before it")
{
    const TemporaryFolder folder;
    const std::string line = "\tgeometry = { generator = \"\u00e9\u00e9\", inner = true }";
    const std::string shown = text_of(
        with(minimal_case, "geometry = { generator = \"test_shell\", inner = \"1 cm\", outer = \"2 cm\" }", line),
        folder / "case.toml");
    // The tab is kept, every other character becomes one space.
    CHECK(contains(shown,
                   line + "\n       | \t" + std::string(std::string("geometry = { generator = ").size(), ' ') + "^\n"));
}

TEST_CASE("an error of a file as a whole has no line")
{
    const TemporaryFolder folder;
    const std::string file = (folder / "case.toml").string();
    const std::string shown = text_of(with(minimal_case, "title = \"minimal\"\n", ""), file);
    CHECK(contains(shown, file + ": error: missing key 'title' in the case\n"));
}

TEST_CASE("an error of an override shows the override instead of a place")
{
    PluginRegistry registry = test_registry();
    const TemporaryFolder folder;
    write_file(folder / "case.toml", minimal_case);
    try {
        read_case(folder / "case.toml", {{"time.safty=0.5"}, {}}, registry);
        FAIL("took an unknown key");
    } catch (const CaseError& error) {
        CHECK(std::string(error.what()).starts_with("--set time.safty=0.5: error: unknown key 'safty' in [time]\n"));
    }
}

TEST_CASE("a key of ten megabytes is refused at once and with a short message")
{
    const TemporaryFolder folder;
    const std::string key(10 << 20, 'k');
    const std::string shown = text_of(minimal_case + key + " = 1\n", folder / "case.toml");
    CHECK(contains(shown, "unknown key 'kkkk"));
    CHECK(shown.size() < 5000);
}

TEST_CASE("of thousands of errors the first hundred are told and the others counted")
{
    const TemporaryFolder folder;
    std::string text = "[oddments]\n";
    for (int n = 0; n < 5000; ++n)
        text = fmt::format("odd{} = 1\n", n) + text;
    const std::string shown = text_of(text + minimal_case, folder / "case.toml");
    CHECK(contains(shown, "errors more\n"));
    CHECK(shown.size() < 200000);
}
