// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cairo.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "files/render/canvas.hpp"

namespace flagstone::render {

enum class Align : std::uint8_t { left, center, right };

/// How a line of text looks: height of the font in pixels, weight and colour.
struct Font {
  double size;
  bool bold;
  Color color;
};

/// `text` with every control character and every byte that is not UTF-8 replaced by '?': file names
/// may hold anything, and Cairo refuses such text.
std::string printable(std::string_view text);

/// Width of one line of printable text, pixels.
double text_width(cairo_t* context, const std::string& text, const Font& font) noexcept;

/// `text` made printable, and cut out of its middle until it is at most `width` pixels wide.
std::string fitted(cairo_t* context, std::string_view text, const Font& font, double width);

/// `font`, smaller where printable text would else be wider than `width` pixels.
Font shrunk(cairo_t* context, const std::string& text, Font font, double width) noexcept;

/// Draws one line of printable text; (x, baseline) is the point `align` speaks of.
void draw_text(cairo_t* context, double x, double baseline, const std::string& text,
               const Font& font, Align align = Align::left) noexcept;

/// Draws it like draw_text with an edge of another colour, so that it can be read on top of points
/// and lines.
void draw_edged_text(cairo_t* context, double x, double baseline, const std::string& text,
                     const Font& font, Color edge, Align align = Align::left) noexcept;

/// Draws a box for text on top of points and lines, so that hardly any shows through.
void draw_backing(cairo_t* context, const Rectangle& box, double unit, Color color) noexcept;

/// A count with its thousands set apart: "124,668".
std::string grouped(std::size_t count);

/// A share in per cent with one decimal: "53.1 %"; of nothing: "0.0 %". What is not zero never
/// reads as zero: "<0.1 %".
std::string percent(std::size_t part, std::size_t whole);

/// Writes title and subtitle into `heading`, above the panel.
void draw_heading(const Canvas& canvas, const Rectangle& heading, double unit,
                  std::string_view title, std::string_view subtitle);

}  // namespace flagstone::render
