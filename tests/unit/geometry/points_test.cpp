// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Geometry plugin "points": files of both formats, what is refused in them, the cubes around the points.
#include "shape_checks.hpp"

#include "support/case_text.hpp"
#include "support/errors.hpp"
#include "support/plugins.hpp"
#include "support/temporary_folder.hpp"

#include <H5Cpp.h>
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>
#include <random>

namespace {

using namespace periporo;

std::unique_ptr<Geometry> points(const std::filesystem::path& file)
{
    return test::geometry("points", {{"file", file.string()}});
}

std::unique_ptr<Geometry> points_of_csv(const std::string& text, const std::string& name = "points.csv")
{
    const test::TemporaryFolder folder;
    test::write_file(folder / name, text);
    return points(folder / name);
}

std::string error_of_csv(const std::string& text)
{
    const std::string message = test::message_of_error([&] { points_of_csv(text); });
    test::check_mentions(message, {"geometry plugin \"points\"", "points.csv: "});
    return message;
}

template <class Value>
void write_dataset(H5::H5File& file, const std::string& name, const std::vector<hsize_t>& extent,
                   const H5::PredType& type, const std::vector<Value>& values)
{
    file.createDataSet(name, type, H5::DataSpace(static_cast<int>(extent.size()), extent.data()))
        .write(values.data(), type);
}

/// What the plugin says of a file that `write` fills.
template <class Write>
std::string error_of_hdf5(Write&& write)
{
    const test::TemporaryFolder folder;
    {
        H5::H5File file((folder / "points.h5").string(), H5F_ACC_TRUNC);
        write(file);
    }
    const std::string message = test::message_of_error([&] { points(folder / "points.h5"); });
    test::check_mentions(message, {"geometry plugin \"points\"", "points.h5: "});
    return message;
}

const std::string three = "x,y,z,volume\n0,0,0,8\n4,0.5,0,1\n-3,1e1,0.25,0.125\n";

} // namespace

TEST_CASE("the points of a CSV file are those that fill the body, in order")
{
    const auto geometry = points_of_csv(three);
    const PointCloud cloud = geometry->fill(1.0);
    REQUIRE(cloud.positions.size() == 3);
    CHECK(cloud.positions[0] == Vector3(0.0, 0.0, 0.0));
    CHECK(cloud.positions[1] == Vector3(4.0, 0.5, 0.0));
    CHECK(cloud.positions[2] == Vector3(-3.0, 10.0, 0.25));
    CHECK(cloud.volumes == std::vector<double>{8.0, 1.0, 0.125});
    CHECK(geometry->volume() == 9.125);
}

TEST_CASE(
    "columns of a CSV file may come in any order, quoted, among others, with blanks, empty lines and from Windows")
{
    const auto geometry =
        points_of_csv("\xef\xbb\xbf\"volume\", z,colour ,y,x\r\n\r\n 1 ,2,red,3,4\r\n1,5,\"blue\",+6,7", "Points.CSV");
    const PointCloud cloud = geometry->fill(1.0);
    REQUIRE(cloud.positions.size() == 2);
    CHECK(cloud.positions[0] == Vector3(4.0, 3.0, 2.0));
    CHECK(cloud.positions[1] == Vector3(7.0, 6.0, 5.0));
    const std::vector<std::string> remarks = geometry->remarks();
    REQUIRE(remarks.size() == 2);
    test::check_mentions(remarks[1], {"not used", "colour"});
}

TEST_CASE("the points of an HDF5 file are those that fill the body, whatever the type of the numbers")
{
    const test::TemporaryFolder folder;
    {
        H5::H5File file((folder / "points.hdf5").string(), H5F_ACC_TRUNC);
        write_dataset<float>(file, "position", {2, 3}, H5::PredType::NATIVE_FLOAT,
                             {0.5F, 1.0F, 2.0F, 3.0F, 4.0F, 5.0F});
        write_dataset<int>(file, "volume", {2}, H5::PredType::NATIVE_INT, {1, 2});
    }
    const auto geometry = points(folder / "points.hdf5");
    const PointCloud cloud = geometry->fill(1.1);
    REQUIRE(cloud.positions.size() == 2);
    CHECK(cloud.positions[0] == Vector3(0.5, 1.0, 2.0));
    CHECK(cloud.positions[1] == Vector3(3.0, 4.0, 5.0));
    CHECK(cloud.volumes == std::vector<double>{1.0, 2.0});
}

TEST_CASE("the remark says how many points there are and how large they are together")
{
    const std::vector<std::string> remarks = points_of_csv(three)->remarks();
    REQUIRE(remarks.size() == 1);
    test::check_mentions(remarks[0], {"points.csv", "3 points of 9.125 m3"});
}

TEST_CASE("what lies in the cube of a point's volume around it is inside, the faces included, exactly")
{
    const auto geometry = points_of_csv(three); // cubes of 2, 1 and 0.5 m
    test::check_closed_region(*geometry, {-1.0, -1.0, -1.0}, {1.0, 1.0, 1.0});
    test::check_closed_region(*geometry, {3.5, 0.0, -0.5}, {4.5, 1.0, 0.5});
    test::check_closed_region(*geometry, {-3.25, 9.75, 0.0}, {-2.75, 10.25, 0.5});
    CHECK_FALSE(geometry->contains(Vector3(2.0, 0.0, 0.0)));
    CHECK_FALSE(geometry->contains(Vector3(0.0, 0.0, std::numeric_limits<double>::quiet_NaN())));
    CHECK_FALSE(geometry->contains(Vector3(0.0, 0.0, std::numeric_limits<double>::infinity())));
    CHECK(geometry->bounds().lower == Vector3(-3.25, -1.0, -1.0));
    CHECK(geometry->bounds().upper == Vector3(4.5, 10.25, 1.0));
}

TEST_CASE("a face that no double lies on is between the two doubles next to it")
{
    // Half the cube root of 2 in extended precision, which tells doubles apart 2048 times finer than they are.
    const long double face = 0.5L * std::cbrt(2.0L);
    double below = static_cast<double>(face);
    if (static_cast<long double>(below) > face)
        below = test::just_below(below);
    const auto geometry = points_of_csv("x,y,z,volume\n0,0,0,2\n");
    for (int k = 0; k < 3; ++k)
        for (const double side : {-1.0, 1.0}) {
            CHECK(geometry->contains(side * below * Vector3::Unit(k)));
            CHECK_FALSE(geometry->contains(side * test::just_above(below) * Vector3::Unit(k)));
        }
}

TEST_CASE("among many points of very different volumes, inside is what a look at each of them finds")
{
    std::mt19937 generator(3);
    std::uniform_real_distribution<double> part(0.0, 1.0);
    std::string text = "x,y,z,volume\n";
    std::vector<std::array<double, 4>> all; // with half an edge at the end
    for (int i = 0; i < 300; ++i) {
        const double half = 0.1 * std::pow(part(generator), 4.0) + 1e-4;
        all.push_back({part(generator), part(generator), part(generator), half});
        text += fmt::format("{},{},{},{}\n", all.back()[0], all.back()[1], all.back()[2], 8.0 * half * half * half);
    }
    const auto geometry = points_of_csv(text);
    int inside = 0;
    for (int i = 0; i < 3000; ++i) {
        const Vector3 place(part(generator), part(generator), part(generator));
        const bool expected = std::any_of(all.begin(), all.end(), [&](const std::array<double, 4>& point) {
            return (place - Vector3(point[0], point[1], point[2])).lpNorm<Eigen::Infinity>() <= point[3];
        });
        CHECK(geometry->contains(place) == expected);
        inside += expected ? 1 : 0;
    }
    CHECK(inside > 300);
    CHECK(inside < 2700);
}

TEST_CASE("a spacing that differs from the cube root of the median volume by more than a fifth is an error")
{
    // Cubes of 1, 2, 2, 2 and 50 m: the median is 2 m.
    const auto geometry = points_of_csv("x,y,z,volume\n0,0,0,1\n9,0,0,8\n99,0,0,125000\n0,9,0,8\n0,0,9,8\n");
    CHECK(geometry->fill(2.0 / 1.19).positions.size() == 5);
    CHECK(geometry->fill(2.0 / 0.81).positions.size() == 5);
    test::check_mentions(test::message_of_error([&] { geometry->fill(2.0 / 1.21); }),
                         {"points.csv", "cube of 2 m", "1.21 times the spacing", "0.8 and 1.2 times"});
    test::check_mentions(test::message_of_error([&] { geometry->fill(2.0 / 0.79); }), {"cube of 2 m", "0.79 times"});
    test::check_mentions(test::message_of_error([&] { geometry->fill(0.001); }), {"2e+03 times", "spacing of 2 m"});
}

TEST_CASE("a header without a column, or with one twice, is an error that shows it")
{
    test::check_mentions(error_of_csv("x,y,volume\n0,0,1\n"),
                         {"line 1: the header names no column z [m]", "must name x [m], y [m], z [m] and volume [m3]"});
    test::check_mentions(error_of_csv("x,y,z,x,volume\n0,0,0,0,1\n"), {"line 1: two columns are named x"});
    test::check_mentions(error_of_csv("0,0,0,1\n"), {"the header names no column x [m]"});
    test::check_mentions(error_of_csv("\n \n"), {"no header"});
}

TEST_CASE("what is no number or no point in a CSV file is an error with its line")
{
    test::check_mentions(error_of_csv(three + "1,2,3\n"),
                         {"line 5: 3 cells, and 4 in the header", "a cell for each column"});
    test::check_mentions(error_of_csv(three + "\n1,2,three,1\n"), {"line 6: z is \"three\""});
    test::check_mentions(error_of_csv(three + "1,2,,1\n"), {"line 5: z is \"\""});
    test::check_mentions(error_of_csv(three + "1,2,3 m,1\n"), {"line 5: z is \"3 m\""});
    test::check_mentions(error_of_csv(three + "1,2,1e999,1\n"), {"line 5: z is \"1e999\""});
    test::check_mentions(error_of_csv(three + "1,nan,2,1\n"), {"line 5: y is \"nan\"", "no finite number"});
    test::check_mentions(error_of_csv(three + "1,2,3,inf\n"), {"line 5: volume is \"inf\""});
    test::check_mentions(error_of_csv(three + "1,2,3,0\n"), {"line 5: the volume must be positive", "not 0"});
    test::check_mentions(error_of_csv(three + "1,2,3,-1\n"), {"line 5: the volume", "not -1"});
    test::check_mentions(error_of_csv("x,y,z,volume\n"), {"no points"});
}

TEST_CASE("two points at one place are an error with both lines")
{
    test::check_mentions(error_of_csv(three + "1,2,3,1\n4,0.5,-0,2\n"),
                         {"line 3 and line 6 put two points at one place, (4, 0.5, 0)"});
}

TEST_CASE("datasets that are not there or of another shape are errors that name them")
{
    const auto& real = H5::PredType::NATIVE_DOUBLE;
    const std::vector<double> six{0.0, 0.0, 0.0, 1.0, 1.0, 1.0};
    const std::vector<double> two{1.0, 1.0};
    test::check_mentions(error_of_hdf5([](H5::H5File& file) { file.createGroup("position"); }),
                         {"no dataset \"position\" of n x 3 numbers"});
    test::check_mentions(error_of_hdf5([&](H5::H5File& file) {
                             write_dataset(file, "position", {2, 3}, real, six);
                         }),
                         {"no dataset \"volume\" of n numbers"});
    test::check_mentions(error_of_hdf5([&](H5::H5File& file) {
                             write_dataset(file, "position", {3, 2}, real, six);
                         }),
                         {"dataset \"position\" must hold n x 3 numbers"});
    test::check_mentions(error_of_hdf5([&](H5::H5File& file) { write_dataset(file, "position", {6}, real, six); }),
                         {"dataset \"position\" must hold n x 3 numbers"});
    test::check_mentions(error_of_hdf5([&](H5::H5File& file) {
                             write_dataset(file, "position", {2, 3}, real, six);
                             write_dataset(file, "volume", {2, 1}, real, two);
                         }),
                         {"dataset \"volume\" must hold n numbers"});
    test::check_mentions(error_of_hdf5([&](H5::H5File& file) {
                             write_dataset(file, "position", {2, 3}, real, six);
                             write_dataset(file, "volume", {1}, real, two);
                         }),
                         {"\"position\" holds 2 points, and \"volume\" 1"});
    test::check_mentions(error_of_hdf5([&](H5::H5File& file) {
                             write_dataset(file, "position", {2, 3}, real, six);
                             write_dataset<double>(file, "volume", {2}, real, {1.0, -1.0});
                         }),
                         {"point 1: the volume must be positive"});
}

TEST_CASE("a file that is not what its name says, or says nothing, is an error")
{
    const test::TemporaryFolder folder;
    test::write_file(folder / "points.h5", three);
    test::check_mentions(test::message_of_error([&] { points(folder / "points.h5"); }), {"points.h5: HDF5: "});
    test::write_file(folder / "points.txt", three);
    test::check_mentions(test::message_of_error([&] { points(folder / "points.txt"); }),
                         {"points.txt: ", ".csv, .h5 and .hdf5"});
    test::check_mentions(test::message_of_error([&] { points(folder / "none.csv"); }), {"none.csv: cannot be read"});
}
