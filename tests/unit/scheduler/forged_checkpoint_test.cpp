// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Checkpoints with a right checksum and a content that no run writes: refused with their name, or gone on from, but
// never a crash, a hang or memory that the file asks for.
#include "case/reader.hpp"
#include "io/checkpoint.hpp"
#include "scheduler/run.hpp"
#include "support/archives.hpp"
#include "support/case_text.hpp"
#include "support/temporary_folder.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <set>
#include <string>

using namespace periporo;
using namespace periporo::test;

namespace {

/// A quarter of a wet block that settles on an obstacle and slides off it: all that a run can keep.
const std::string case_text = R"(title = "a block on a plate"
[discretization]
spacing = "10 mm"
[material.soil]
model = "viscoplastic_critical_state"
grain_density = "2200 kg/m3"
porosity = 0.2
bulk_modulus = "25 MPa"
shear_modulus = "15 MPa"
critical_state_slope = 1.1
compression_index = 0.12
swelling_index = 0.04
viscosity = "1000 Pa3 s"
[body.block]
geometry = { generator = "box", size = ["40 mm", "40 mm", "50 mm"] }
material = "soil"
water = { type = "hydrostatic", water_table = "z = 20 mm", saturation = 0.3 }
[obstacle.plate]
geometry = { generator = "box", size = ["200 mm", "200 mm", "20 mm"], origin = ["-10 mm", "-10 mm", "-20 mm"] }
velocity = ["100 mm/s", "0 mm/s", "0 mm/s"]
[[boundary]]
type = "symmetry"
plane = "y = 0 mm"
[[contact]]
law = "short_range"
between = ["block", "plate"]
modulus = "4 MPa"
friction = 0.5
[[contact]]
law = "short_range"
between = ["block", "block"]
modulus = "4 MPa"
friction = 0.5
[[stage]]
name = "settle"
type = "quasi_static"
until = { residual = 0.1 }
[[stage]]
name = "slide"
type = "dynamic"
duration = "20 ms"
until = { rest_speed = "1 mm/s" }
water = [{ body = "block", type = "uniform", suction = "2 kPa", saturation = 0.1, over = "10 ms" }]
[[output]]
writer = "csv"
every = "5 ms"
)";

/// A run that was stopped in its last stage.
class StoppedRun {
public:
    StoppedRun()
    {
        write_file(folder_ / "case.toml", case_text);
        description_ = read_case(folder_ / "case.toml", {{}, {PERIPORO_BUILD_DIR "/lib/periporo"}}, registry_);
        options_.directory = folder_ / "out";
        options_.threads = 1;
        options_.quiet = true;
        options_.stop_after = stop;
        REQUIRE(run_case(description_, registry_, options_) == RunOutcome::interrupted);
        sound_ = bytes_of(checkpoint());
        options_.resume = true;
        options_.stop_after = stop + 3;
    }

    std::filesystem::path checkpoint() const { return options_.directory / checkpoint_name; }
    ArchiveContent sound() const
    {
        write_bytes(checkpoint(), sound_);
        return ArchiveContent(checkpoint());
    }
    /// Goes on from a checkpoint for three steps; what is said when it does not.
    std::string message(const ArchiveContent& content) const
    {
        std::filesystem::remove(options_.directory / previous_checkpoint_name);
        content.write(checkpoint());
        try {
            run_case(description_, registry_, options_);
        } catch (const std::exception& error) {
            return error.what();
        }
        return {};
    }

private:
    static constexpr std::uint64_t stop = 200;
    TemporaryFolder folder_;
    PluginRegistry registry_;
    CaseDescription description_;
    RunOptions options_;
    std::string sound_;
};

} // namespace

TEST_CASE("no checkpoint with a right checksum and senseless content brings a run down")
{
    const StoppedRun run;
    const ArchiveContent sound = run.sound();
    REQUIRE(sound.entries.size() > 50);
    REQUIRE(run.message(sound) == "");
    // Images of one more symmetry plane, and blanks behind a text.
    const std::set<std::string> may_be_longer{"model/neighbourhood/images/isometries", "report/stages", "case"};
    for (std::size_t e = 0; e < sound.entries.size(); ++e) {
        const ArchiveContent::Entry& entry = sound.entries[e];
        CAPTURE(entry.name);
        const auto forged = [&](auto&& forge) {
            ArchiveContent content = sound;
            forge(content.entries[e]);
            return run.message(content);
        };
        const auto names_file = [&](const std::string& message) {
            CAPTURE(message);
            CHECK(message.find(checkpoint_name) != std::string::npos);
        };
        const std::size_t size = size_of(entry.kind);
        if (!may_be_longer.contains(entry.name))
            for (const std::uint64_t more : {std::uint64_t{1}, std::uint64_t{12}, entry.count + 1})
                names_file(forged([&](ArchiveContent::Entry& other) {
                    other.count += more;
                    other.numbers += std::string(more * size, ' ');
                }));
        if (entry.count > 1 && entry.name != "case") // a case means the same without its last end of a line
            names_file(forged([&](ArchiveContent::Entry& other) {
                other.count -= 1;
                other.numbers.resize(other.count * size);
            }));
        names_file(forged([](ArchiveContent::Entry& other) { other.name = "another"; }));
        forged([](ArchiveContent::Entry& other) { other.count = 0, other.numbers.clear(); });
        for (const char byte : {'\0', '\x7f', '\xff'})
            forged([&](ArchiveContent::Entry& other) { std::ranges::fill(other.numbers, byte); });
        if (entry.count > 1)
            forged([&](ArchiveContent::Entry& other) {
                std::ranges::rotate(other.numbers, other.numbers.begin() + static_cast<std::ptrdiff_t>(size));
            });
    }
}

TEST_CASE("times that are no numbers, infinite or negative, and stages that are not there, are refused")
{
    const StoppedRun run;
    const ArchiveContent sound = run.sound();
    const auto check_refused = [&](const std::string& name, const auto& value) {
        CAPTURE(name);
        CAPTURE(value);
        ArchiveContent content = sound;
        const auto entry = std::ranges::find(content.entries, name, &ArchiveContent::Entry::name);
        REQUIRE(entry != content.entries.end());
        REQUIRE(entry->numbers.size() == sizeof(value));
        std::memcpy(entry->numbers.data(), &value, sizeof(value));
        CHECK(run.message(content).find(checkpoint_name) != std::string::npos);
    };
    for (const char* name : {"position/time", "position/stage_start", "position/time_step", "report/wall_seconds"})
        for (const double value :
             {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), -1.0})
            check_refused(name, value);
    check_refused("position/time_step", 0.0);
    for (const std::uint64_t stage : {std::uint64_t{2}, ~std::uint64_t{0}})
        check_refused("position/stage", stage);
}
