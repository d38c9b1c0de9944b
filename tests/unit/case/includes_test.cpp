// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Cases made of several files.
#include "unit/case/case_support.hpp"

#include <sys/stat.h>

using namespace periporo;
using namespace periporo::test;

namespace {

/// Reads `case.toml` of a folder with the files given.
CaseDescription read_files(const TemporaryFolder& folder, const std::vector<std::pair<std::string, std::string>>& files)
{
    for (const auto& [name, text] : files)
        write_file(folder / name, text);
    PluginRegistry registry = test_registry();
    return read_case(folder / "case.toml", {}, registry);
}

std::vector<CaseDiagnostic> errors_of_files(const TemporaryFolder& folder,
                                            const std::vector<std::pair<std::string, std::string>>& files)
{
    try {
        read_files(folder, files);
    } catch (const CaseError& error) {
        return error.diagnostics();
    }
    return {};
}

} // namespace

TEST_CASE("the including file overrides key by key and keeps the rest")
{
    const TemporaryFolder folder;
    const CaseDescription read =
        read_files(folder, {{"base.toml", minimal_case},
                            {"case.toml", "include = [\"base.toml\"]\n[material.soil]\nporosity = 0.4\n"}});
    CHECK(read.materials[0].porosity == 0.4);
    CHECK(read.materials[0].grain_density == 2200.0);
    CHECK(read.title == "minimal");
}

TEST_CASE("lists of tables are replaced as a whole")
{
    const TemporaryFolder folder;
    const CaseDescription read =
        read_files(folder, {{"base.toml", minimal_case},
                            {"case.toml", "include = [\"base.toml\"]\n[[stage]]\nname = \"only\"\ntype = \"dynamic\"\n"
                                          "duration = 1\n"}});
    REQUIRE(read.stages.size() == 1);
    CHECK(read.stages[0].name == "only");
}

TEST_CASE("a later include overrides an earlier one")
{
    const TemporaryFolder folder;
    const CaseDescription read = read_files(folder, {{"base.toml", minimal_case},
                                                     {"fine.toml", "[discretization]\nspacing = 0.001\n"},
                                                     {"case.toml", "include = [\"base.toml\", \"fine.toml\"]\n"}});
    CHECK(read.discretization.spacing == 0.001);
}

TEST_CASE("includes are relative to the file that includes, and may include others")
{
    const TemporaryFolder folder;
    const CaseDescription read = read_files(folder, {{"common/soil/base.toml", minimal_case},
                                                     {"common/all.toml", "include = [\"soil/base.toml\"]\n"},
                                                     {"case.toml", "include = [\"common/all.toml\"]\n"}});
    CHECK(read.title == "minimal");
}

TEST_CASE("an error in an included file has that file's place")
{
    const TemporaryFolder folder;
    const std::string base = with(minimal_case, "porosity", "prosity");
    const auto errors =
        errors_of_files(folder, {{"base.toml", base}, {"case.toml", "include = [\"base.toml\"]\ntitle = \"t\"\n"}});
    REQUIRE(errors.size() == 1);
    CHECK(errors[0].file == folder / "base.toml");
    CHECK(place_of(errors[0]) == place_in(base, "prosity"));
}

TEST_CASE("files that include each other are an error at the include, with the chain")
{
    const TemporaryFolder folder;
    const auto errors =
        errors_of_files(folder, {{"a.toml", "include = [\"case.toml\"]\n"}, {"case.toml", "include = [\"a.toml\"]\n"}});
    REQUIRE(errors.size() == 1);
    CHECK(errors[0].file == folder / "a.toml");
    CHECK(place_of(errors[0]) == LineColumn{1, 12});
    CHECK(contains(errors[0].message, "includes itself"));
    CHECK(contains(errors[0].hint, "a.toml includes"));
}

TEST_CASE("one file may be included along two ways")
{
    const TemporaryFolder folder;
    CHECK(errors_of_files(folder, {{"base.toml", minimal_case},
                                   {"a.toml", "include = [\"base.toml\"]\n"},
                                   {"b.toml", "include = [\"base.toml\"]\n"},
                                   {"case.toml", "include = [\"a.toml\", \"b.toml\"]\n"}})
              .empty());
}

TEST_CASE("an included file that is not there is an error at the include")
{
    const TemporaryFolder folder;
    const auto errors = errors_of_files(folder, {{"case.toml", "include = [\"base.toml\"]\n"}});
    REQUIRE(errors.size() == 1);
    CHECK(errors[0].file == folder / "case.toml");
    CHECK(place_of(errors[0]) == LineColumn{1, 12});
    CHECK(contains(errors[0].message, "no such file"));
}

TEST_CASE("an include that is no list of texts is an error")
{
    for (const std::string value : {"\"base.toml\"", "[1]", "3"}) {
        CAPTURE(value);
        const TemporaryFolder folder;
        const auto errors = errors_of_files(folder, {{"case.toml", "include = " + value + "\n" + minimal_case}});
        REQUIRE(errors.size() == 1);
        CHECK(contains(errors[0].message, "'include' must be a list of texts"));
    }
}

TEST_CASE("plugin folders of an included file are relative to that file")
{
    const TemporaryFolder folder;
    const CaseDescription read =
        read_files(folder, {{"lab/base.toml", minimal_case + "[plugins]\npaths = [\"ours\"]\n"},
                            {"case.toml", "include = [\"lab/base.toml\"]\n"}});
    REQUIRE(read.plugin_paths.size() == 1);
    CHECK(read.plugin_paths[0] == folder / "lab/ours");
}

TEST_CASE("a file that is included by many ways is read once, so that no number of ways takes long")
{
    // each of 40 files includes the next one twice: 2^40 ways to the last
    const TemporaryFolder folder;
    write_file(folder / "part40.toml", minimal_case);
    for (int n = 39; n > 10; --n)
        write_file(folder / fmt::format("part{}.toml", n),
                   fmt::format("include = [\"part{0}.toml\", \"part{0}.toml\"]\n", n + 1));
    const CaseDescription read = read_files(folder, {{"case.toml", "include = [\"part11.toml\"]\n"}});
    CHECK(read.title == "minimal");
}

TEST_CASE("a very long chain of includes is an error, not the end of the stack")
{
    const TemporaryFolder folder;
    for (int n = 0; n < 5000; ++n)
        write_file(folder / fmt::format("part{}.toml", n), fmt::format("include = [\"part{}.toml\"]\n", n + 1));
    const auto errors = errors_of_files(folder, {{"case.toml", "include = [\"part0.toml\"]\n"}});
    REQUIRE(errors.size() == 1);
    CHECK(contains(errors[0].message, "more than 32 files include one another"));
}

TEST_CASE("pipes and devices are no cases, and reading them does not wait for ever")
{
    const TemporaryFolder folder;
    REQUIRE(mkfifo((folder / "pipe").c_str(), 0600) == 0);
    for (const std::string name : {"pipe", "/dev/zero"}) {
        CAPTURE(name);
        const auto errors = errors_of_files(folder, {{"case.toml", "include = [\"" + name + "\"]\n"}});
        REQUIRE(errors.size() == 1);
        CHECK(contains(errors[0].message, "it is no regular file"));
    }
}

TEST_CASE("a case of many megabytes is refused before it is read")
{
    const TemporaryFolder folder;
    write_file(folder / "huge.toml", "");
    std::filesystem::resize_file(folder / "huge.toml", std::uintmax_t{1} << 36); // takes no room on the disk
    const auto errors = errors_of_files(folder, {{"case.toml", "include = [\"huge.toml\"]\n"}});
    REQUIRE(errors.size() == 1);
    CHECK(contains(errors[0].message, "it has more than 16 MB"));
}
