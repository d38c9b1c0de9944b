// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Drawings as SVG 1.1: a few shapes, in pixels from the upper left corner.
#pragma once

#include <filesystem>
#include <string>

namespace periporo {

class SvgDrawing {
public:
    SvgDrawing(double width, double height);

    struct Style {
        std::string fill = "none";   ///< colour "#rrggbb"
        std::string stroke = "none"; ///< of the outline
        double width = 1.0;          ///< of the outline
        double opacity = 1.0;
        bool dashed = false;
    };
    void circle(double x, double y, double radius, const Style& style);
    void line(double x0, double y0, double x1, double y1, const Style& style);
    void rectangle(double x, double y, double width, double height, const Style& style);
    /// @param anchor "start", "middle" or "end": which end of the text lies at x
    void text(double x, double y, const std::string& text, double size, const char* anchor = "start",
              const char* colour = "#222222");

    /// @throws std::runtime_error when the file cannot be written.
    void save(const std::filesystem::path& file) const;

private:
    std::string body_;
};

} // namespace periporo
