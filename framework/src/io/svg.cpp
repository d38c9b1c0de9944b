// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
#include "io/svg.hpp"

#include "periporo/file.hpp"

#include <fmt/format.h>

namespace periporo {
namespace {

std::string escaped(const std::string& text)
{
    std::string result;
    for (const char c : text) {
        if (c == '&')
            result += "&amp;";
        else if (c == '<')
            result += "&lt;";
        else if (c == '>')
            result += "&gt;";
        else
            result += c;
    }
    return result;
}

std::string attributes(const SvgDrawing::Style& style)
{
    std::string text = fmt::format("fill=\"{}\"", style.fill);
    if (style.stroke != "none")
        text += fmt::format(" stroke=\"{}\" stroke-width=\"{:.2f}\"", style.stroke, style.width);
    if (style.opacity < 1.0)
        text += fmt::format(" opacity=\"{:.2f}\"", style.opacity);
    if (style.dashed)
        text += " stroke-dasharray=\"6 4\"";
    return text;
}

} // namespace

SvgDrawing::SvgDrawing(double width, double height)
    : body_(fmt::format("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" viewBox=\"0 0 "
                        "{0:.0f} {1:.0f}\" font-family=\"sans-serif\">\n<rect width=\"100%\" height=\"100%\" "
                        "fill=\"#ffffff\"/>\n",
                        width, height))
{
}

void SvgDrawing::circle(double x, double y, double radius, const Style& style)
{
    body_ += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{:.1f}\" {}/>\n", x, y, radius, attributes(style));
}

void SvgDrawing::line(double x0, double y0, double x1, double y1, const Style& style)
{
    body_ += fmt::format("<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" {}/>\n", x0, y0, x1, y1,
                         attributes(style));
}

void SvgDrawing::rectangle(double x, double y, double width, double height, const Style& style)
{
    body_ += fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" {}/>\n", x, y, width,
                         height, attributes(style));
}

void SvgDrawing::text(double x, double y, const std::string& text, double size, const char* anchor, const char* colour)
{
    body_ +=
        fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" font-size=\"{:.0f}\" text-anchor=\"{}\" fill=\"{}\">{}</text>\n",
                    x, y, size, anchor, colour, escaped(text));
}

void SvgDrawing::save(const std::filesystem::path& file) const
{
    write_whole(file, body_ + "</svg>\n");
}

} // namespace periporo
