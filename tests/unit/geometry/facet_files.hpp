// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Writes facets for tests, in every format that "surface_mesh" reads.
#pragma once

#include "polyhedra.hpp"
#include "support/temporary_folder.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <bit>
#include <cstdint>
#include <fstream>
#include <string>
#include <vector>

namespace periporo::test {

/// Facets with any number of corners.
struct Facets {
    std::vector<Vector3> points;
    std::vector<std::vector<std::size_t>> polygons;

    Facets() = default;
    Facets(const Polyhedron& body) : points(body.points)
    {
        for (const auto& triangle : body.triangles)
            polygons.emplace_back(triangle.begin(), triangle.end());
    }
};

inline std::string words(const Vector3& point)
{
    return fmt::format("{} {} {}", point.x(), point.y(), point.z());
}

inline std::string stl(const Facets& facets)
{
    std::string text = "solid test\n";
    for (const auto& polygon : facets.polygons) {
        text += " facet normal 0 0 0\n  outer loop\n";
        for (const std::size_t corner : polygon)
            text += "   vertex " + words(facets.points[corner]) + '\n';
        text += "  endloop\n endfacet\n";
    }
    return text + "endsolid test\n";
}

inline std::string off(const Facets& facets)
{
    std::string text = fmt::format("OFF\n{} {} 0\n", facets.points.size(), facets.polygons.size());
    for (const Vector3& point : facets.points)
        text += words(point) + '\n';
    for (const auto& polygon : facets.polygons)
        text += fmt::format("{} {}\n", polygon.size(), fmt::join(polygon, " "));
    return text;
}

inline std::string obj(const Facets& facets)
{
    std::string text = "# test\no body\n";
    for (const Vector3& point : facets.points)
        text += "v " + words(point) + '\n';
    for (const auto& polygon : facets.polygons) {
        text += 'f';
        for (const std::size_t corner : polygon)
            text += fmt::format(" {}", corner + 1);
        text += '\n';
    }
    return text;
}

inline std::string ply_header(const Facets& facets, const std::string& format)
{
    return fmt::format(
        "ply\nformat {} 1.0\nelement vertex {}\nproperty double x\nproperty double y\nproperty double z\n"
        "element face {}\nproperty list uchar int vertex_indices\nend_header\n",
        format, facets.points.size(), facets.polygons.size());
}

inline std::string ply(const Facets& facets)
{
    std::string text = ply_header(facets, "ascii");
    for (const Vector3& point : facets.points)
        text += words(point) + '\n';
    for (const auto& polygon : facets.polygons)
        text += fmt::format("{} {}\n", polygon.size(), fmt::join(polygon, " "));
    return text;
}

template <class Value>
void append_bytes(std::string& bytes, Value value)
{
    static_assert(std::endian::native == std::endian::little);
    bytes.append(reinterpret_cast<const char*>(&value), sizeof(value));
}

inline std::string binary_ply(const Facets& facets)
{
    std::string bytes = ply_header(facets, "binary_little_endian");
    for (const Vector3& point : facets.points)
        for (const double coordinate : point)
            append_bytes(bytes, coordinate);
    for (const auto& polygon : facets.polygons) {
        append_bytes(bytes, static_cast<std::uint8_t>(polygon.size()));
        for (const std::size_t corner : polygon)
            append_bytes(bytes, static_cast<std::int32_t>(corner));
    }
    return bytes;
}

/// @param header the first of its 80 bytes, which may be anything, even "solid" as in a text
inline std::string binary_stl(const Facets& facets, std::string header = "test")
{
    header.resize(80, ' ');
    append_bytes(header, static_cast<std::uint32_t>(facets.polygons.size()));
    for (const auto& polygon : facets.polygons) {
        for (int i = 0; i < 3; ++i)
            append_bytes(header, 0.0F); // of the normal
        for (const std::size_t corner : polygon)
            for (const double coordinate : facets.points[corner])
                append_bytes(header, static_cast<float>(coordinate));
        append_bytes(header, std::uint16_t{0});
    }
    return header;
}

/// Writes a file and returns its full path.
inline std::string write_file(const TemporaryFolder& folder, const std::string& name, const std::string& content)
{
    std::ofstream(folder / name, std::ios::binary) << content;
    return (folder / name).string();
}

} // namespace periporo::test
