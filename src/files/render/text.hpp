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

/// A font: height in pixels, weight and colour.
struct Font {
  double size;
  bool bold;
  Color color;
};

/// `text` with every control character and every byte that is not UTF-8 replaced by '?'. File names
/// may contain any bytes, and Cairo does not accept them.
std::string printable(std::string_view text);

/// Width of one line of printable text in pixels.
double text_width(cairo_t* context, const std::string& text, const Font& font) noexcept;

/// `text` made printable, and shortened in the middle to at most `width` pixels.
std::string fitted(cairo_t* context, std::string_view text, const Font& font, double width);

/// `font`, reduced if printable text would otherwise be wider than `width` pixels.
Font shrunk(cairo_t* context, const std::string& text, Font font, double width) noexcept;

/// Draws one line of printable text, aligned to the point (x, baseline).
void draw_text(cairo_t* context, double x, double baseline, const std::string& text,
               const Font& font, Align align = Align::left) noexcept;

/// As draw_text(), with an edge of another colour, so that the text is readable on top of points
/// and lines.
void draw_edged_text(cairo_t* context, double x, double baseline, const std::string& text,
                     const Font& font, Color edge, Align align = Align::left) noexcept;

/// Draws a nearly opaque box as background for text on top of points and lines.
void draw_backing(cairo_t* context, const Rectangle& box, double unit, Color color) noexcept;

/// A count with thousands separators: "124,668".
std::string grouped(std::size_t count);

/// A percentage with one decimal: "53.1 %". "0.0 %" if `whole` is 0. A small value that is not zero
/// is "<0.1 %".
std::string percent(std::size_t part, std::size_t whole);

/// Writes title and subtitle into `heading`, above the panel.
void draw_heading(const Canvas& canvas, const Rectangle& heading, double unit,
                  std::string_view title, std::string_view subtitle);

}  // namespace flagstone::render
