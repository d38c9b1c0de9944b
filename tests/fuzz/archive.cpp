// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Fuzz target: the entries of a checkpoint, behind a right mark and before a right checksum.
#include "io/archive.hpp"
#include "fuzz_input.hpp"
#include "support/archives.hpp"

namespace {

/// A part with members of every kind.
struct Part {
    bool flag = true;
    double number = 1.5;
    std::uint64_t count = 3;
    std::string text = "text";
    std::vector<double> reals = {1.0, 2.0, 3.0};
    std::vector<periporo::Vector3> vectors = {{1.0, 2.0, 3.0}};
    std::vector<std::uint32_t> indices = {7, 8};

    template <class Self, class Visit>
    static void members(Self& self, Visit& visit)
    {
        constexpr std::size_t most = 1000;
        visit("flag", self.flag);
        visit("number", self.number);
        visit("count", self.count);
        visit("text", periporo::at_most(self.text, most));
        visit("reals", periporo::exactly(self.reals, 3));
        visit("vectors", periporo::empty_or(self.vectors, 1));
        visit("indices", periporo::at_most(self.indices, most));
    }
};

/// An archive as the writer writes it, without its checksum.
std::string sound_archive()
{
    const periporo::test::TemporaryFolder folder;
    periporo::ArchiveWriter writer(folder / "archive");
    writer.part("part", Part{});
    writer.commit();
    std::string bytes = periporo::test::bytes_of(folder / "archive");
    bytes.resize(bytes.size() - periporo::test::checksum_size);
    return bytes;
}

} // namespace

/// Changes are made to the entries of a sound archive: the input is xored over them, and lengthens them.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    using namespace periporo;
    static const test::FuzzFile file("archive");
    static const std::string sound = sound_archive();
    std::string bytes = sound;
    bytes.resize(std::max(bytes.size(), test::mark_size + size));
    for (std::size_t n = 0; n < size; ++n)
        bytes[test::mark_size + n] = static_cast<char>(bytes[test::mark_size + n] ^ data[n]);
    return test::read_or_refuse([&] {
        Part part;
        test::write_with_checksum(file.path(), bytes);
        ArchiveReader(file.path()).part("part", part);
    });
}
