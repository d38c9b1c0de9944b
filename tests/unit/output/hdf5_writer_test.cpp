// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Output plugin "hdf5": the layout and every bit of it, complete files, resumed runs, the XDMF description.
#include "made_up_run.hpp"
#include "result_content.hpp"

#include "support/errors.hpp"
#include "support/plugins.hpp"
#include "support/temporary_folder.hpp"

#include "periporo/earlier_output.hpp"

#include <doctest/doctest.h>

#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <functional>
#include <iterator>
#include <numeric>
#include <set>
#include <utility>

namespace {

using namespace periporo;
using test::content_of;
using test::TemporaryFolder;

std::map<std::string, std::string> whole_run(std::uint64_t last_step)
{
    const TemporaryFolder folder;
    test::write_whole_run(*test::output("hdf5"), folder.path(), last_step);
    return content_of(folder / "results.h5");
}

/// Compares name by name, so that a difference is told by its name.
void check_same(const std::map<std::string, std::string>& found, const std::map<std::string, std::string>& expected)
{
    for (const auto& [name, value] : expected) {
        INFO(name);
        REQUIRE(found.contains(name));
        CHECK((found.at(name) == value)); // parentheses: the values are not for printing
    }
    CHECK(found.size() == expected.size());
}

template <class Value>
std::vector<Value> read(const H5::H5File& file, const std::string& name, const H5::PredType& type)
{
    const H5::DataSet dataset = file.openDataSet(name);
    std::vector<Value> values(static_cast<std::size_t>(dataset.getSpace().getSimpleExtentNpoints()));
    dataset.read(values.data(), type);
    return values;
}

std::vector<double> reals(const H5::H5File& file, const std::string& name)
{
    return read<double>(file, name, H5::PredType::NATIVE_DOUBLE);
}

std::vector<std::int64_t> integers(const H5::H5File& file, const std::string& name)
{
    return read<std::int64_t>(file, name, H5::PredType::NATIVE_INT64);
}

std::vector<hsize_t> extent(const H5::H5File& file, const std::string& name)
{
    const H5::DataSpace space = file.openDataSet(name).getSpace();
    std::vector<hsize_t> result(static_cast<std::size_t>(space.getSimpleExtentNdims()));
    space.getSimpleExtentDims(result.data());
    return result;
}

std::string text(const H5::H5Object& object, const std::string& attribute)
{
    std::string value;
    const H5::Attribute opened = object.openAttribute(attribute);
    opened.read(opened.getStrType(), value);
    return value;
}

template <class Value>
Value number(const H5::H5Object& object, const std::string& attribute, const H5::PredType& type)
{
    Value value{};
    object.openAttribute(attribute).read(type, &value);
    return value;
}

std::string text_dataset(const H5::H5File& file, const std::string& name)
{
    std::string value;
    const H5::DataSet dataset = file.openDataSet(name);
    dataset.read(value, dataset.getStrType());
    return value;
}

/// What a run leaves that is stopped at a step.
void stop_at(const std::filesystem::path& folder, std::uint64_t step)
{
    const auto writer = test::output("hdf5");
    writer->begin(test::made_up_run(folder));
    test::give_steps(*writer, 0, step);
    writer->flush(step);
    writer->finish(false);
}

/// Resumes at a step and runs to the end; @return what the writer says aloud.
/// @param expected snapshots that the checkpoint knows; none: the writer is not told
std::string finish_from(const std::filesystem::path& folder, std::uint64_t step, std::uint64_t last_step,
                        const std::vector<SnapshotMoment>& expected = {})
{
    std::string said;
    RunDescription run = test::resumed_run(folder, step);
    run.warn = [&](const std::string& warning) { said += warning + '\n'; };
    const auto writer = test::output("hdf5");
    dynamic_cast<EarlierOutputReader&>(*writer).expect(expected);
    writer->begin(run);
    test::give_steps(*writer, step + 1, last_step);
    writer->finish(true);
    writer->clean_up();
    return said;
}

/// Flips a bit of the byte at a part of the length.
void flip_bit(const std::filesystem::path& file, double place)
{
    std::fstream stream(file, std::ios::binary | std::ios::in | std::ios::out);
    const auto at = static_cast<std::streamoff>(place * static_cast<double>(std::filesystem::file_size(file)));
    stream.seekg(at);
    const char byte = static_cast<char>(stream.get() ^ 0x10);
    stream.seekp(at);
    stream.put(byte);
}

/// The text between the quotes of `key="..."`.
std::string xml_value(const std::string& element, const std::string& key)
{
    const std::size_t start = element.find(key + "=\"") + key.size() + 2;
    return element.substr(start, element.find('"', start) - start);
}

std::string file_text(const std::filesystem::path& path)
{
    std::ifstream stream(path, std::ios::binary);
    REQUIRE(stream.is_open());
    return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

} // namespace

TEST_CASE("positions and fields come back bit by bit, with their shape, unit and description")
{
    const TemporaryFolder folder;
    test::write_whole_run(*test::output("hdf5"), folder.path(), 10);
    const H5::H5File file((folder / "results.h5").string(), H5F_ACC_RDONLY);
    const std::size_t n = test::made_up_points;
    CHECK(reals(file, "/snapshots/000001/position") == test::made_up_values(10, 3 * n, 100));
    CHECK(extent(file, "/snapshots/000001/position") == std::vector<hsize_t>{n, 3});
    CHECK(reals(file, "/snapshots/000001/velocity") == test::made_up_values(10, 3 * n, 200));
    CHECK(extent(file, "/snapshots/000001/velocity") == std::vector<hsize_t>{n, 3});
    CHECK(reals(file, "/snapshots/000001/plastic_shear_strain") == test::made_up_values(10, n, 300));
    CHECK(extent(file, "/snapshots/000001/plastic_shear_strain") == std::vector<hsize_t>{n});
    CHECK(reals(file, "/snapshots/000001/effective_stress") == test::made_up_values(10, 6 * n, 400));
    CHECK(extent(file, "/snapshots/000001/effective_stress") == std::vector<hsize_t>{n, 6});
    CHECK(integers(file, "/snapshots/000001/family_size").at(7) == 10 * 1000 + 7 - 5);
    const H5::DataSet stress = file.openDataSet("/snapshots/000001/effective_stress");
    CHECK(text(stress, "unit") == "Pa");
    CHECK(text(stress, "description") == "Tension-positive; xx yy zz xy yz xz");
    CHECK(text(file.openDataSet("/snapshots/000001/position"), "unit") == "m");
}

TEST_CASE("each snapshot says its step, time and stage")
{
    const TemporaryFolder folder;
    test::write_whole_run(*test::output("hdf5"), folder.path(), 20);
    const H5::H5File file((folder / "results.h5").string(), H5F_ACC_RDONLY);
    REQUIRE(file.openGroup("/snapshots").getNumObjs() == 3);
    const H5::Group last = file.openGroup("/snapshots/000002");
    CHECK(number<std::int64_t>(last, "step", H5::PredType::NATIVE_INT64) == 20);
    CHECK(number<double>(last, "time", H5::PredType::NATIVE_DOUBLE) == test::made_up_time(20));
    CHECK(text(last, "stage") == "collapse");
    CHECK(text(file.openGroup("/snapshots/000000"), "stage") == "geostatic");
}

TEST_CASE("the root says what the file is, and the provenance is there entry by entry")
{
    const TemporaryFolder folder;
    test::write_whole_run(*test::output("hdf5"), folder.path(), 0);
    const H5::H5File file((folder / "results.h5").string(), H5F_ACC_RDONLY);
    const RunDescription run = test::made_up_run(folder.path());
    CHECK(text(file, "format") == "periporo results");
    CHECK(number<std::int64_t>(file, "format_version", H5::PredType::NATIVE_INT64) == 1);
    CHECK(number<std::int64_t>(file, "complete", H5::PredType::NATIVE_INT64) == 1);
    CHECK(text(file, "title") == run.title);
    CHECK(text_dataset(file, "/provenance/resolved_case") == run.resolved_case);
    CHECK(text_dataset(file, "/provenance/version") == "0.1.0");
    CHECK(text_dataset(file, "/provenance/plugin geometry_box") == "sha256 0123"); // a name holds no slash
}

TEST_CASE("the history comes back bit by bit, column by column, however many rows there are")
{
    const TemporaryFolder folder;
    const auto writer = test::output("hdf5");
    writer->begin(test::made_up_run(folder.path()));
    const std::uint64_t rows = 2500; // more than the writer keeps, more than a chunk holds, and no multiple of either
    for (std::uint64_t step = 0; step < rows; ++step)
        writer->history(3 * step, test::made_up_row(step));
    writer->finish(true);
    const H5::H5File file((folder / "results.h5").string(), H5F_ACC_RDONLY);
    const std::vector<std::int64_t> steps = integers(file, "/history/step");
    const std::vector<double> time = reals(file, "/history/time");
    const std::vector<double> energy = reals(file, "/history/kinetic_energy");
    const std::vector<double> grains = reals(file, "/history/free_grains");
    REQUIRE(steps.size() == rows);
    REQUIRE(time.size() == rows);
    REQUIRE(energy.size() == rows);
    REQUIRE(grains.size() == rows);
    bool same = true;
    for (std::uint64_t i = 0; i < rows; ++i)
        same = same && steps[i] == static_cast<std::int64_t>(3 * i) &&
               std::vector<double>{time[i], energy[i], grains[i]} == test::made_up_row(i);
    CHECK(same);
    CHECK(text(file.openDataSet("/history/kinetic_energy"), "unit") == "J");
    CHECK(text(file.openDataSet("/history/kinetic_energy"), "description") == "Kinetic energy of all points");
}

TEST_CASE("while a run goes on results.h5 opens at every moment, and shows all snapshots and rows after a flush")
{
    const TemporaryFolder folder;
    const auto writer = test::output("hdf5");
    writer->begin(test::made_up_run(folder.path()));
    for (std::uint64_t snapshots = 1; snapshots <= 3; ++snapshots) {
        test::give_steps(*writer, 10 * (snapshots - 1) + 1, 10 * snapshots);
        CHECK_NOTHROW(content_of(folder / "results.h5"));
        writer->flush(10 * snapshots);
        const H5::H5File file((folder / "results.h5").string(), H5F_ACC_RDONLY);
        CHECK(file.openGroup("/snapshots").getNumObjs() == snapshots);
        CHECK(integers(file, "/history/step").back() == static_cast<std::int64_t>(10 * snapshots));
        CHECK(number<std::int64_t>(file, "complete", H5::PredType::NATIVE_INT64) == 0);
        const std::size_t n = test::made_up_points;
        const std::string last = fmt::format("/snapshots/{:06}/position", snapshots - 1);
        CHECK(reals(file, last) == test::made_up_values(10 * snapshots, 3 * n, 100));
    }
    writer->finish(false);
    const H5::H5File file((folder / "results.h5").string(), H5F_ACC_RDONLY);
    CHECK(number<std::int64_t>(file, "complete", H5::PredType::NATIVE_INT64) == 0);
    CHECK(text(file, "parts").find("results.parts") != std::string::npos);
}

TEST_CASE("a complete run leaves one file that holds everything, and no parts")
{
    const TemporaryFolder folder;
    const TemporaryFolder elsewhere;
    test::write_whole_run(*test::output("hdf5"), folder.path(), 20);
    CHECK_FALSE(std::filesystem::exists(folder / "results.parts"));
    std::filesystem::copy(folder / "results.h5", elsewhere / "results.h5");
    check_same(content_of(elsewhere / "results.h5"), content_of(folder / "results.h5"));
    CHECK_FALSE(H5::H5File((elsewhere / "results.h5").string(), H5F_ACC_RDONLY).attrExists("parts"));
}

TEST_CASE("somebody who has the result file open and locked does not stop the run, and keeps what was opened")
{
    const TemporaryFolder folder;
    const auto writer = test::output("hdf5");
    writer->begin(test::made_up_run(folder.path()));
    test::give_steps(*writer, 0, 10);
    writer->flush(10);
    const int descriptor = ::open((folder / "results.h5").c_str(), O_RDONLY);
    REQUIRE(::flock(descriptor, LOCK_SH | LOCK_NB) == 0);
    const H5::H5File open((folder / "results.h5").string(), H5F_ACC_RDONLY);
    CHECK_NOTHROW(test::give_steps(*writer, 11, 30));
    CHECK_NOTHROW(writer->flush(30));
    CHECK(integers(open, "/history/step").size() == 11);
    CHECK(reals(open, "/snapshots/000001/position").size() == 3 * test::made_up_points);
    ::close(descriptor);
    CHECK_NOTHROW(writer->finish(true));
}

TEST_CASE("result file and XDMF are not written anew at each snapshot when they are larger than the snapshots")
{
    const TemporaryFolder folder;
    const auto writer = test::output("hdf5");
    writer->begin(test::made_up_run(folder.path()));
    std::set<ino_t> files; // each writing aside makes another file
    std::uintmax_t written = 0;
    for (std::uint64_t step = 0; step < 600; ++step) {
        test::give_snapshot(*writer, step, 1);
        struct stat state;
        REQUIRE(::stat((folder / "results.h5").c_str(), &state) == 0);
        if (files.insert(state.st_ino).second) {
            files = {state.st_ino};
            written +=
                std::filesystem::file_size(folder / "results.h5") + std::filesystem::file_size(folder / "results.xdmf");
        }
    }
    std::uintmax_t parts = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder / "results.parts"))
        parts += entry.file_size();
    // They are written when as many bytes of snapshots wait: a last writing that no snapshots stand against is allowed.
    CHECK(written < parts + std::filesystem::file_size(folder / "results.xdmf") + 200000);
    CHECK(written > 0);
}

TEST_CASE("a run that was stopped and resumed leaves the same file as one that never stopped")
{
    const TemporaryFolder folder;
    stop_at(folder.path(), 40);
    finish_from(folder.path(), 40, 60);
    check_same(content_of(folder / "results.h5"), whole_run(60));
    CHECK_FALSE(std::filesystem::exists(folder / "results.parts"));
}

TEST_CASE("after a kill the run goes on from its checkpoint and leaves the same file")
{
    const TemporaryFolder running;
    const TemporaryFolder killed;
    const auto first = test::output("hdf5");
    first->begin(test::made_up_run(running.path()));
    test::give_steps(*first, 0, 33);
    first->flush(33);
    test::give_steps(*first, 34, 57);
    // The files as a kill at this moment would leave them, with snapshots and rows after the checkpoint.
    std::filesystem::copy(running.path(), killed.path(), std::filesystem::copy_options::recursive);
    CHECK(finish_from(killed.path(), 33, 60).empty());
    check_same(content_of(killed / "results.h5"), whole_run(60));
}

TEST_CASE("a run that is resumed at a step whose snapshot and row are stored stores them once")
{
    const TemporaryFolder folder;
    stop_at(folder.path(), 40);
    const auto second = test::output("hdf5");
    second->begin(test::resumed_run(folder.path(), 40));
    test::give_steps(*second, 40, 60);
    second->finish(true);
    check_same(content_of(folder / "results.h5"), whole_run(60));
}

TEST_CASE("the XDMF of a resumed run is that of one that never stopped")
{
    const TemporaryFolder whole;
    test::write_whole_run(*test::output("hdf5"), whole.path(), 40);
    const TemporaryFolder folder;
    stop_at(folder.path(), 20);
    finish_from(folder.path(), 20, 40);
    CHECK(file_text(folder / "results.xdmf") == file_text(whole / "results.xdmf"));
}

TEST_CASE("a bit that flips in a part is noticed wherever it is, and the part is set aside, named, and left out")
{
    const auto expected = whole_run(60);
    for (const double place : {0.0, 0.3, 0.5, 0.8, 0.999}) {
        CAPTURE(place);
        const TemporaryFolder folder;
        stop_at(folder.path(), 45);
        flip_bit(folder / "results.parts/000002-20.h5", place);
        const std::string said = finish_from(folder.path(), 45, 60);
        test::check_mentions(said, {"snapshot 000002 of step 20", "000002-20.h5.damaged"});
        auto found = content_of(folder / "results.h5");
        CHECK(found.at("/@missing").find("snapshot 000002 of step 20") != std::string::npos);
        CHECK(std::filesystem::exists(folder / "results.parts/000002-20.h5.damaged"));
        CHECK_FALSE(found.contains("/snapshots/000002/"));
        found.erase("/@missing");
        auto without = expected;
        std::erase_if(without, [](const auto& entry) { return entry.first.starts_with("/snapshots/000002"); });
        check_same(found, without);
    }
}

TEST_CASE("a sound part under the name of another snapshot is set aside, named, and left out")
{
    struct Copy {
        const char* from;
        const char* to;
        const char* said;
    };
    const std::vector<Copy> copies{
        {"000001-10.h5", "000003-30.h5", "lost: snapshot 000003 of step 30, time 2.3 s, damaged, kept as"},
        {"000001-10.h5", "000002-10.h5",
         "is no snapshot of this run, damaged, kept as results.parts/000002-10.h5.damaged"},
        {"000001-10.h5", "000007-10.h5",
         "is no snapshot of this run, damaged, kept as results.parts/000007-10.h5.damaged"}};
    for (const Copy& copy : copies) {
        CAPTURE(copy.to);
        const TemporaryFolder folder;
        stop_at(folder.path(), 45);
        std::filesystem::copy_file(folder / "results.parts" / copy.from, folder / "results.parts" / copy.to,
                                   std::filesystem::copy_options::overwrite_existing);
        std::vector<SnapshotMoment> expected;
        for (std::uint64_t step = 0; step <= 40; step += 10)
            expected.push_back({step, test::made_up_time(step)});
        test::check_mentions(finish_from(folder.path(), 45, 60, expected), {copy.said});
        CHECK(std::filesystem::exists(folder / "results.parts" / (copy.to + std::string(".damaged"))));
        auto without = whole_run(60);
        auto found = content_of(folder / "results.h5");
        if (copy.to == std::string("000003-30.h5")) {
            CHECK(found.at("/@missing").find("snapshot 000003 of step 30") != std::string::npos);
            found.erase("/@missing");
            std::erase_if(without, [](const auto& entry) { return entry.first.starts_with("/snapshots/000003"); });
        }
        check_same(found, without);
    }
}

TEST_CASE("a part of another run that has the same number and step is no part of this one")
{
    const TemporaryFolder other;
    const auto writer = test::output("hdf5");
    writer->begin(test::made_up_run(other.path()));
    for (std::uint64_t step = 0; step <= 20; step += 10)
        test::give_snapshot(*writer, step, test::made_up_points + 1);
    const TemporaryFolder folder;
    stop_at(folder.path(), 45);
    std::filesystem::copy_file(other / "results.parts/000002-20.h5", folder / "results.parts/000002-20.h5",
                               std::filesystem::copy_options::overwrite_existing);
    test::check_mentions(finish_from(folder.path(), 45, 60), {"lost: snapshot 000002 of step 20, damaged"});
}

TEST_CASE("a part that somebody replaces by another one while the run goes on is not merged")
{
    const TemporaryFolder folder;
    std::string said;
    RunDescription run = test::made_up_run(folder.path());
    run.warn = [&](const std::string& warning) { said += warning; };
    const auto writer = test::output("hdf5");
    writer->begin(run);
    test::give_steps(*writer, 0, 45);
    std::filesystem::copy_file(folder / "results.parts/000001-10.h5", folder / "results.parts/000002-20.h5",
                               std::filesystem::copy_options::overwrite_existing);
    writer->finish(true);
    test::check_mentions(said, {"000002-20.h5 was damaged or deleted"});
    CHECK_FALSE(content_of(folder / "results.h5").contains("/snapshots/000002/position"));
}

TEST_CASE("a part that is cut or missing is named, and the others go on")
{
    const TemporaryFolder folder;
    stop_at(folder.path(), 45);
    std::filesystem::resize_file(folder / "results.parts/000001-10.h5", 1000);
    std::filesystem::remove(folder / "results.parts/000004-40.h5"); // the last one
    std::ofstream(folder / "results.parts/000003-30.h5", std::ios::trunc).close();
    const std::string said = finish_from(folder.path(), 45, 60);
    test::check_mentions(said,
                         {"snapshot 000001 of step 10", "snapshot 000003 of step 30", "snapshot 000004 of step 40"});
    const auto found = content_of(folder / "results.h5");
    for (const char* kept : {"/snapshots/000000/", "/snapshots/000002/", "/snapshots/000005/", "/snapshots/000006/"})
        CHECK(found.contains(kept));
    CHECK(found.at("/history/step") == whole_run(60).at("/history/step"));
}

TEST_CASE("rows of a damaged journal are lost one by one, and never read as numbers")
{
    const auto expected = whole_run(60);
    for (const double place : {0.2, 0.5, 0.9}) {
        CAPTURE(place);
        const TemporaryFolder folder;
        stop_at(folder.path(), 45);
        flip_bit(folder / "results.parts/journal", place);
        test::check_mentions(finish_from(folder.path(), 45, 60), {"rows of the history between steps"});
        CHECK(std::filesystem::exists(folder / "results.parts/journal.damaged"));
        const H5::H5File file((folder / "results.h5").string(), H5F_ACC_RDONLY);
        const std::vector<std::int64_t> steps = integers(file, "/history/step");
        const std::vector<double> energy = reals(file, "/history/kinetic_energy");
        CHECK(steps.size() >= 60); // of 61, when it is a row that was hit
        CHECK(std::is_sorted(steps.begin(), steps.end()));
        for (std::size_t r = 0; r < steps.size(); ++r)
            CHECK(energy[r] == test::made_up_value(static_cast<std::uint64_t>(steps[r]), 0));
    }
}

TEST_CASE("bytes that are doubled, lost or put into a journal cost no row behind them")
{
    constexpr std::size_t head = 64, record = 24 + 3 * sizeof(double); // of a journal with three values a record
    const auto expected = whole_run(60);
    const std::size_t place = head + 20 * record; // in front of a row
    struct Change {
        const char* name;
        std::function<void(std::string&)> make;
        std::size_t rows;
        const char* said;
    };
    const std::vector<Change> changes{
        {"a record doubled", [&](std::string& bytes) { bytes.insert(place, bytes.substr(place, record)); }, 61,
         "journal was damaged and is mended; no row is lost"},
        {"bytes put in", [&](std::string& bytes) { bytes.insert(place, "of somebody else"); }, 61,
         "journal was damaged and is mended; no row is lost"},
        {"two rows exchanged",
         [&](std::string& bytes) {
             const std::string row = bytes.substr(place, record);
             bytes.erase(place, record).insert(place + record, row);
         },
         60, "rows of the history between steps"},
        {"a record lost", [&](std::string& bytes) { bytes.erase(place, record); }, 60,
         "rows of the history between steps"},
        {"a byte lost", [&](std::string& bytes) { bytes.erase(place + 7, 1); }, 60,
         "rows of the history between steps"}};
    for (const Change& change : changes) {
        CAPTURE(change.name);
        const TemporaryFolder folder;
        stop_at(folder.path(), 45);
        std::string bytes = file_text(folder / "results.parts/journal");
        change.make(bytes);
        std::ofstream(folder / "results.parts/journal", std::ios::binary) << bytes;
        test::check_mentions(finish_from(folder.path(), 45, 60), {change.said});
        CHECK(std::filesystem::exists(folder / "results.parts/journal.damaged"));
        const H5::H5File file((folder / "results.h5").string(), H5F_ACC_RDONLY);
        const std::vector<std::int64_t> steps = integers(file, "/history/step");
        const std::vector<double> energy = reals(file, "/history/kinetic_energy");
        CHECK(steps.size() == change.rows);
        CHECK(std::adjacent_find(steps.begin(), steps.end(), std::greater_equal<>()) == steps.end());
        for (std::size_t r = 0; r < steps.size(); ++r)
            CHECK(energy[r] == test::made_up_value(static_cast<std::uint64_t>(steps[r]), 0));
        CHECK(content_of(folder / "results.h5").contains("/snapshots/000006/position"));
    }
}

TEST_CASE("a journal that ends before the checkpoint is said to lack rows, and one of zeros has none")
{
    for (const bool zeros : {false, true}) {
        const TemporaryFolder folder;
        stop_at(folder.path(), 45);
        const auto journal = folder / "results.parts/journal";
        const auto size = std::filesystem::file_size(journal);
        std::filesystem::resize_file(journal, size / 2);
        if (zeros) // as a file system leaves them after a power cut
            std::filesystem::resize_file(journal, size);
        test::check_mentions(finish_from(folder.path(), 45, 60), {"rows of the history between steps", "and 45"});
        const H5::H5File file((folder / "results.h5").string(), H5F_ACC_RDONLY);
        const std::vector<std::int64_t> steps = integers(file, "/history/step");
        CHECK(steps.size() < 61);
        CHECK(std::adjacent_find(steps.begin(), steps.end(), std::greater_equal<>()) == steps.end());
        CHECK(text(file, "missing").find("and 45") != std::string::npos);
    }
}

TEST_CASE("a loss is said again by every resume, and in the file at the end")
{
    const TemporaryFolder folder;
    stop_at(folder.path(), 45);
    flip_bit(folder / "results.parts/journal", 0.5);
    flip_bit(folder / "results.parts/000002-20.h5", 0.5);
    const auto second = test::output("hdf5");
    second->begin(test::resumed_run(folder.path(), 45));
    test::give_steps(*second, 46, 50);
    second->flush(50);
    second->finish(false);
    test::check_mentions(finish_from(folder.path(), 50, 60), {"snapshot 000002 of step 20", "rows of the history"});
    CHECK_FALSE(std::filesystem::exists(folder / "results.parts/journal.damaged.2"));
}

TEST_CASE("whatever the files are, a checkpoint resumes: without its parts, with a result file that is none")
{
    const TemporaryFolder folder;
    stop_at(folder.path(), 45);
    std::ofstream(folder / "results.h5", std::ios::trunc) << "no HDF5";
    CHECK(finish_from(folder.path(), 45, 60).empty()); // the parts have it all
    check_same(content_of(folder / "results.h5"), whole_run(60));
    const TemporaryFolder without;
    stop_at(without.path(), 45);
    std::filesystem::remove_all(without / "results.parts");
    test::check_mentions(finish_from(without.path(), 45, 60), {"results.parts is not there", "results.h5.damaged"});
    CHECK(content_of(without / "results.h5").contains("/snapshots/000000/"));
}

TEST_CASE("the writer says what it finds of an earlier run, before it changes anything")
{
    const auto look = [](const std::filesystem::path& folder) {
        const auto writer = test::output("hdf5");
        const auto* reader = dynamic_cast<const EarlierOutputReader*>(writer.get());
        REQUIRE(reader != nullptr);
        return reader->earlier_output(folder);
    };
    const TemporaryFolder folder;
    CHECK(look(folder.path()).holds.empty());
    CHECK(look(folder.path()).missing_result == "results.h5");
    stop_at(folder.path(), 45);
    CHECK(look(folder.path()).snapshots == std::vector<std::uint64_t>{0, 10, 20, 30, 40});
    CHECK(look(folder.path()).missing_record.empty());
    CHECK_FALSE(look(folder.path()).complete);
    test::check_mentions(fmt::format("{}", fmt::join(look(folder.path()).holds, ", ")),
                         {"5 snapshots in results.parts", "5 snapshots and 46 rows in results.h5"});
    finish_from(folder.path(), 45, 60);
    CHECK(look(folder.path()).complete);
    CHECK(look(folder.path()).missing_result.empty());
    std::ofstream(folder / "results.h5", std::ios::trunc) << "no HDF5";
    CHECK_FALSE(look(folder.path()).complete);
    CHECK(look(folder.path()).missing_result == "results.h5");
}

TEST_CASE("a run without its parts goes on with the numbers that its snapshots have, and names those that are lost")
{
    const TemporaryFolder folder;
    stop_at(folder.path(), 45);
    std::filesystem::remove_all(folder / "results.parts");
    const auto writer = test::output("hdf5");
    dynamic_cast<EarlierOutputReader&>(*writer).expect({{0, 0.0}, {10, 0.1}, {20, 0.2}, {30, 0.3}, {40, 0.4}});
    writer->begin(test::resumed_run(folder.path(), 45));
    test::give_steps(*writer, 46, 60);
    writer->finish(true);
    const auto found = content_of(folder / "results.h5");
    CHECK_FALSE(found.contains("/snapshots/000000/position"));
    CHECK(found.contains("/snapshots/000005/position"));
    CHECK(found.contains("/snapshots/000006/position"));
    test::check_mentions(found.at("/@missing"),
                         {"snapshot 000000 of step 0, time 0 s", "snapshot 000004 of step 40, time 0.4 s"});
}

TEST_CASE("a link in place of the folder of parts is not followed")
{
    const TemporaryFolder folder;
    const TemporaryFolder elsewhere;
    std::ofstream(elsewhere / "000000-0.h5") << "of somebody else";
    std::filesystem::create_directory_symlink(elsewhere.path(), folder / "results.parts");
    test::write_whole_run(*test::output("hdf5"), folder.path(), 20);
    CHECK(file_text(elsewhere / "000000-0.h5") == "of somebody else");
    check_same(content_of(folder / "results.h5"), whole_run(20));
}

TEST_CASE("only the fields asked for are stored, positions always")
{
    const TemporaryFolder folder;
    test::write_whole_run(*test::output("hdf5", {{"fields", std::vector<std::string>{"velocity"}}}), folder.path(), 0);
    const H5::H5File file((folder / "results.h5").string(), H5F_ACC_RDONLY);
    const H5::Group snapshot = file.openGroup("/snapshots/000000");
    CHECK(snapshot.getNumObjs() == 2);
    CHECK(snapshot.nameExists("position"));
    CHECK(snapshot.nameExists("velocity"));
}

TEST_CASE("a field that does not exist is an error with the names of those that do")
{
    const TemporaryFolder folder;
    const auto writer = test::output("hdf5", {{"fields", std::vector<std::string>{"speed"}}});
    writer->begin(test::made_up_run(folder.path()));
    test::check_mentions(test::message_of_error([&] { test::give_snapshot(*writer, 0); }),
                         {"\"speed\"", "velocity, plastic_shear_strain, effective_stress, family_size"});
}

TEST_CASE("compression changes the size of the file and not its content")
{
    const auto whole = [](std::int64_t level, std::uintmax_t& size) {
        const TemporaryFolder folder;
        const auto writer = test::output("hdf5", {{"compression", level}});
        writer->begin(test::made_up_run(folder.path()));
        const std::vector<double> positions(3 * 10000, 1.0);
        Snapshot snapshot;
        snapshot.positions = positions;
        writer->snapshot(snapshot);
        writer->finish(true);
        size = std::filesystem::file_size(folder / "results.h5");
        return content_of(folder / "results.h5");
    };
    std::uintmax_t plain_size = 0;
    std::uintmax_t packed_size = 0;
    const auto plain = whole(0, plain_size);
    const auto packed = whole(9, packed_size);
    check_same(packed, plain);
    CHECK(plain_size > 3 * 10000 * sizeof(double));
    CHECK(packed_size < plain_size / 5); // 30,000 equal numbers
}

TEST_CASE("a snapshot without points is stored as such")
{
    const TemporaryFolder folder;
    const auto writer = test::output("hdf5");
    writer->begin(test::made_up_run(folder.path()));
    test::give_snapshot(*writer, 0, 0);
    writer->finish(true);
    const H5::H5File file((folder / "results.h5").string(), H5F_ACC_RDONLY);
    CHECK(extent(file, "/snapshots/000000/position") == std::vector<hsize_t>{0, 3});
}

TEST_CASE("rows of a run that ends by an error are there for the run that is resumed")
{
    const TemporaryFolder folder;
    {
        const auto writer = test::output("hdf5");
        writer->begin(test::made_up_run(folder.path()));
        test::give_steps(*writer, 0, 33);
        writer->flush(33);
        test::give_steps(*writer, 34, 39);
    }
    finish_from(folder.path(), 33, 60);
    check_same(content_of(folder / "results.h5"), whole_run(60));
}

TEST_CASE("a directory that cannot be written is an error with the path and the reason")
{
    const TemporaryFolder folder;
    std::ofstream(folder / "file") << "not a directory";
    const auto writer = test::output("hdf5");
    test::check_mentions(test::message_of_error([&] { writer->begin(test::made_up_run(folder / "file")); }),
                         {(folder / "file" / "results.parts").string(), "Not a directory"});
}

TEST_CASE("every dataset that the XDMF names is in the result file, with the size and the type it says")
{
    const TemporaryFolder folder;
    test::write_whole_run(*test::output("hdf5"), folder.path(), 20);
    const H5::H5File file((folder / "results.h5").string(), H5F_ACC_RDONLY);
    const std::string xdmf = file_text(folder / "results.xdmf");
    std::size_t items = 0;
    for (std::size_t at = xdmf.find("<DataItem "); at != std::string::npos; at = xdmf.find("<DataItem ", at + 1)) {
        const std::string item = xdmf.substr(at, xdmf.find("</DataItem>", at) - at);
        const std::string place = item.substr(item.find('>') + 1); // "results.h5:/snapshots/..."
        INFO(item);
        REQUIRE(place.starts_with("results.h5:/"));
        const std::string name = place.substr(place.find('/'));
        CHECK(xml_value(item, "Dimensions") == fmt::format("{}", fmt::join(extent(file, name), " ")));
        const bool is_integer = file.openDataSet(name).getTypeClass() == H5T_INTEGER;
        CHECK(xml_value(item, "NumberType") == (is_integer ? "Int" : "Float"));
        ++items;
    }
    // In each of three snapshots: the vertices, the positions and the four fields.
    CHECK(items == 3 * (1 + 1 + 4));
}

TEST_CASE("the XDMF lists every point as a vertex and gives the time of every snapshot")
{
    const TemporaryFolder folder;
    test::write_whole_run(*test::output("hdf5"), folder.path(), 10);
    const std::string xdmf = file_text(folder / "results.xdmf");
    const std::string points = std::to_string(test::made_up_points);
    CHECK(xdmf.find("TopologyType=\"Polyvertex\" NumberOfElements=\"" + points + "\"") != std::string::npos);
    const H5::H5File file((folder / "results.h5").string(), H5F_ACC_RDONLY);
    std::vector<std::int64_t> expected(test::made_up_points);
    std::iota(expected.begin(), expected.end(), 0);
    CHECK(integers(file, "/vertices/" + points) == expected);
    const std::size_t first = xdmf.find("<Time Value=\"-0.7\"/>"); // made_up_time(0)
    const std::size_t second = xdmf.find("<Time Value=\"0.3\"/>"); // made_up_time(10)
    CHECK(first < second);
    CHECK(second != std::string::npos);
    CHECK(xdmf.find("<Time ", second + 1) == std::string::npos);
}

TEST_CASE("the XDMF gives each field the type of its components")
{
    const TemporaryFolder folder;
    test::write_whole_run(*test::output("hdf5"), folder.path(), 0);
    const std::string xdmf = file_text(folder / "results.xdmf");
    for (const auto& [name, type] : {std::pair{"velocity", "Vector"},
                                     {"plastic_shear_strain", "Scalar"},
                                     {"family_size", "Scalar"},
                                     {"effective_stress", "Matrix"}})
        CHECK(xdmf.find(fmt::format("<Attribute Name=\"{}\" AttributeType=\"{}\" Center=\"Node\">", name, type)) !=
              std::string::npos);
}
