// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Reads facets by CGAL's readers of polygon soups, and checks what they let pass.
#include "facet_file.hpp"

#include "periporo/text.hpp"

#include <CGAL/IO/OBJ.h>
#include <CGAL/IO/OFF.h>
#include <CGAL/IO/OFF/File_header_OFF.h>
#include <CGAL/IO/PLY.h>
#include <CGAL/IO/STL.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <optional>
#include <sstream>
#include <stdexcept>

namespace periporo::geometry {

namespace {

constexpr std::size_t most_corners_shown = 6;

bool is_finite(const MeshPoint& point)
{
    return vector(point).allFinite();
}

/// CGAL makes room for as many points and facets as a header names. Each takes a byte of the file at least.
void check_count(const FacetFile& file, double count, const char* what)
{
    if (count > static_cast<double>(std::filesystem::file_size(file.path)))
        file.refuse(fmt::format("the header names {:.4g} {}, more than the file has bytes", count, what));
}

/// Reads the header alone, as CGAL does.
void check_off_header(const FacetFile& file)
{
    std::ifstream stream(file.path, std::ios::binary);
    CGAL::File_header_OFF header;
    if (!(stream >> header))
        return; // the whole file is refused for the same reason
    check_count(file, static_cast<double>(header.size_of_vertices()), "points");
    check_count(file, static_cast<double>(header.size_of_facets()), "facets");
}

bool is_one_of(const std::string& word, std::initializer_list<const char*> words)
{
    return std::ranges::find(words, word) != words.end();
}

/// CGAL's reader of PLY takes the coordinates of a point for float or double.
/// @param words of a line behind "property": type and name, or "list", two types and name
void check_ply_property(const FacetFile& file, std::istringstream& words, std::size_t line)
{
    std::string type, name;
    words >> type;
    for (std::string word; words >> word;)
        name = word;
    if (is_one_of(name, {"x", "y", "z"}) && !is_one_of(type, {"float", "float32", "double", "float64"}))
        file.refuse(fmt::format("line {}: the coordinate {} must be float or double", line, name));
}

/// CGAL's reader of PLY leaves its memory at a property without an element before it and at types that it does not
/// convert, so the header is read first. Each line of it begins with one of these words.
void check_ply_header(const FacetFile& file)
{
    constexpr std::array known{"ply", "format", "comment", "obj_info", "element", "property", "end_header"};
    std::ifstream stream(file.path, std::ios::binary);
    std::string line;
    bool some_element = false;
    for (std::size_t number = 1; std::getline(stream, line); ++number) {
        std::istringstream words(line);
        std::string word;
        words >> word;
        if (word == "end_header")
            return;
        if (!word.empty() && std::ranges::find(known, word) == known.end())
            file.refuse(fmt::format("line {} of the header of a .ply file begins with no word of one", number));
        if (word == "property" && !some_element)
            file.refuse(fmt::format("line {} has a property and no element before it", number));
        if (word == "property")
            check_ply_property(file, words, number);
        if (word != "element")
            continue;
        some_element = true;
        std::string name;
        double count = 0.0;
        words >> name >> count;
        check_count(file, count, "elements");
    }
    file.refuse("the header of a .ply file must end with end_header");
}

bool read(const std::string& format, FacetFile& file)
{
    if (format == ".stl")
        return CGAL::IO::read_STL(file.path, file.points, file.polygons);
    if (format == ".off") {
        check_off_header(file);
        return CGAL::IO::read_OFF(file.path, file.points, file.polygons);
    }
    if (format == ".ply") {
        check_ply_header(file);
        return CGAL::IO::read_PLY(file.path, file.points, file.polygons);
    }
    if (format == ".obj")
        return CGAL::IO::read_OBJ(file.path, file.points, file.polygons);
    file.refuse("the ending of a file of facets must be .stl, .off, .ply or .obj");
}

/// CGAL's reader of binary STL takes a point that is not finite for some other point, so these are looked for first.
/// Such a file has 80 bytes of anything, the number of facets, and per facet a normal, three corners and two bytes.
void check_binary_stl(FacetFile file)
{
    constexpr std::size_t header = 80;
    constexpr std::size_t record = 50;
    std::ifstream stream(file.path, std::ios::binary);
    std::uint32_t count = 0;
    stream.seekg(header);
    stream.read(reinterpret_cast<char*>(&count), sizeof(count));
    if (!stream || std::filesystem::file_size(file.path) != header + sizeof(count) + record * count)
        return;
    std::array<char, record> bytes;
    std::array<std::array<float, 3>, 4> vectors; // the normal and the corners
    for (std::size_t index = 0; index < count && stream.read(bytes.data(), bytes.size()); ++index) {
        std::memcpy(vectors.data(), bytes.data(), sizeof(vectors));
        for (std::size_t corner = 1; corner < vectors.size(); ++corner)
            file.points.emplace_back(vectors[corner][0], vectors[corner][1], vectors[corner][2]);
        if (!std::all_of(file.points.begin(), file.points.end(), is_finite)) {
            file.polygons.resize(index + 1, {0, 1, 2});
            file.refuse(file.facet(index) + " has a coordinate that is not a finite number");
        }
        file.points.clear();
    }
}

/// The first line of a text file with "nan" or "inf" for a number, which no reader takes; from 1.
std::optional<std::size_t> line_with_no_number(const std::string& path)
{
    std::ifstream stream(path);
    std::string line;
    for (std::size_t number = 1; std::getline(stream, line); ++number) {
        std::istringstream words(line);
        for (std::string word; words >> word;) {
            word = lower_case(word.substr(word.front() == '-' || word.front() == '+' ? 1 : 0));
            if (word == "nan" || word == "inf" || word == "infinity")
                return number;
        }
    }
    return std::nullopt;
}

[[noreturn]] void refuse_unreadable(const FacetFile& file, const std::string& format)
{
    if (const auto line = line_with_no_number(file.path))
        file.refuse(fmt::format("line {} has a coordinate that is not a finite number", *line));
    file.refuse(fmt::format("cannot be read as a {} file; it may be damaged, cut off or of another format", format));
}

void check(const FacetFile& file)
{
    if (file.polygons.empty())
        file.refuse("the file has no facets");
    for (std::size_t index = 0; index < file.polygons.size(); ++index) {
        const std::vector<std::size_t>& polygon = file.polygons[index];
        const auto unknown = std::find_if(polygon.begin(), polygon.end(),
                                          [&](std::size_t corner) { return corner >= file.points.size(); });
        if (unknown != polygon.end())
            file.refuse(fmt::format("facet {} has a corner that is none of the {} points of the file", index + 1,
                                    file.points.size()));
        if (polygon.size() < 3)
            file.refuse(file.facet(index) + " has fewer than three corners");
        if (!std::all_of(polygon.begin(), polygon.end(),
                         [&](std::size_t corner) { return is_finite(file.points[corner]); }))
            file.refuse(file.facet(index) + " has a coordinate that is not a finite number");
    }
}

} // namespace

std::string coordinates(const MeshPoint& point)
{
    return fmt::format("({}, {}, {})", point.x(), point.y(), point.z());
}

std::string FacetFile::facet(std::size_t index) const
{
    std::string text = fmt::format("facet {} with the corners", index + 1);
    const std::vector<std::size_t>& polygon = polygons[index];
    for (std::size_t corner = 0; corner < std::min(polygon.size(), most_corners_shown); ++corner)
        text += (corner > 0 ? ", " : " ") + coordinates(points[polygon[corner]]);
    return polygon.size() > most_corners_shown ? text + " and more" : text;
}

void FacetFile::refuse(const std::string& what) const
{
    throw std::runtime_error(fmt::format("{}: {}", path, what));
}

FacetFile read_facets(const std::string& path)
{
    FacetFile file{path, {}, {}};
    const std::string format = lower_case(std::filesystem::path(path).extension().string());
    if (!std::ifstream(path))
        file.refuse("cannot be opened");
    if (format == ".stl")
        check_binary_stl(file);
    bool readable = false;
    try {
        readable = read(format, file);
    } catch (const std::bad_alloc&) {   // a count in the file that is far too large
    } catch (const std::logic_error&) { // a length, or an assertion of CGAL
    }
    if (!readable)
        refuse_unreadable(file, format);
    check(file);
    return file;
}

} // namespace periporo::geometry
