// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// XDMF elements for times, points and fields.
#include "xdmf.hpp"

#include <fmt/format.h>

#include <iterator>

namespace periporo::output {

namespace {

std::string escaped(const std::string& text)
{
    std::string result;
    for (const char c : text)
        switch (c) {
        case '&':
            result += "&amp;";
            break;
        case '<':
            result += "&lt;";
            break;
        case '>':
            result += "&gt;";
            break;
        case '"':
            result += "&quot;";
            break;
        default:
            result += c;
        }
    return result;
}

/// A reference to a dataset of the result file.
std::string data_item(const std::string& data_file, const std::string& dataset, bool integers, std::size_t points,
                      std::size_t components)
{
    const std::string dimensions =
        components == 1 ? fmt::format("{}", points) : fmt::format("{} {}", points, components);
    return fmt::format(R"(<DataItem Format="HDF" NumberType="{}" Precision="8" Dimensions="{}">{}:{}</DataItem>)",
                       integers ? "Int" : "Float", dimensions, escaped(data_file), escaped(dataset));
}

const char* attribute_type(std::size_t components)
{
    switch (components) {
    case 1:
        return "Scalar";
    case 3:
        return "Vector";
    default:
        return "Matrix";
    }
}

std::string grid(const std::string& data_file, const StoredSnapshot& snapshot)
{
    std::string text = fmt::format(
        R"(      <Grid Name="{0}" GridType="Uniform">
        <Time Value="{1}"/>
        <Topology TopologyType="Polyvertex" NumberOfElements="{2}" NodesPerElement="1">
          {3}
        </Topology>
        <Geometry GeometryType="XYZ">
          {4}
        </Geometry>
)",
        snapshot.name(), snapshot.time, snapshot.points,
        data_item(data_file, vertex_list(snapshot.points), true, snapshot.points, 1),
        data_item(data_file, "/snapshots/" + snapshot.name() + "/position", false, snapshot.points, 3));
    for (const StoredField& field : snapshot.fields)
        fmt::format_to(std::back_inserter(text), R"(        <Attribute Name="{}" AttributeType="{}" Center="Node">
          {}
        </Attribute>
)",
                       escaped(field.name), attribute_type(field.components),
                       data_item(data_file, "/snapshots/" + snapshot.name() + "/" + field.name, field.integers,
                                 snapshot.points, field.components));
    return text + "      </Grid>\n";
}

} // namespace

std::string xdmf_text(const std::vector<StoredSnapshot>& snapshots, const std::string& data_file)
{
    std::string text = R"(<?xml version="1.0"?>
<Xdmf Version="3.0">
  <Domain>
    <Grid Name="results" GridType="Collection" CollectionType="Temporal">
)";
    for (const StoredSnapshot& snapshot : snapshots)
        text += grid(data_file, snapshot);
    return text + "    </Grid>\n  </Domain>\n</Xdmf>\n";
}

} // namespace periporo::output
