// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Hashes of what a run reads, and what they say of a change.
#include "io/input_hashes.hpp"
#include "support/case_text.hpp"
#include "support/temporary_folder.hpp"

#include <doctest/doctest.h>

using namespace periporo;
using namespace periporo::test;

namespace {

InputHashes hashes_of(const std::string& text)
{
    return InputHashes::from_text(text);
}

} // namespace

TEST_CASE("the hash of a file is its SHA-256")
{
    const TemporaryFolder folder;
    write_file(folder / "abc", "abc"); // FIPS 180-4, the first example
    CHECK(sha256_of(folder / "abc") == "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
    write_file(folder / "long", std::string(1000000, 'a')); // the third one
    CHECK(sha256_of(folder / "long") == "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
    CHECK_THROWS_AS(sha256_of(folder / "nothing"), std::runtime_error);
}

TEST_CASE("hashes are read back from their text as they were, names with spaces too")
{
    const std::string text = "00ff\tbody.a.geometry.file\t/tmp/my mesh.stl\n12ab\tcase\tcase.toml\n";
    CHECK(hashes_of(text).text() == text);
    CHECK(hashes_of("").text().empty());
}

TEST_CASE("a file that has changed, is new or is gone is named; the case and the program may differ")
{
    const InputHashes before = hashes_of("1\tcase\ta.toml\n2\tprogram\tp\n3\tplugin material sand\tsand.so\n");
    CHECK(before.difference_from(before).empty());
    CHECK(hashes_of("9\tcase\tb.toml\n8\tprogram\tp\n3\tplugin material sand\telsewhere/sand.so\n")
              .difference_from(before)
              .empty());
    CHECK(contains(hashes_of("1\tcase\ta.toml\n4\tplugin material sand\tsand.so\n").difference_from(before),
                   "sand.so (plugin material sand) has changed"));
    CHECK(contains(hashes_of("1\tcase\ta.toml\n").difference_from(before), "sand.so (plugin material sand) was read"));
    CHECK(contains(hashes_of(before.text() + "5\tbody.a.water.file\tw.csv\n").difference_from(before),
                   "w.csv (body.a.water.file) is read now"));
}
