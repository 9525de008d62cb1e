// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "files/render/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <new>
#include <utility>

namespace flagstone::render {
namespace {

bool continues(unsigned char byte) noexcept { return (byte & 0xC0u) == 0x80u; }

// Length of the well-formed UTF-8 character at the start of `text`, or 0 if there is none. RFC
// 3629, section 4: no overlong forms, no surrogates, nothing above U+10FFFF.
std::size_t character_length(std::string_view text) noexcept {
  const auto byte = [text](std::size_t i) noexcept {
    return i < text.size() ? static_cast<unsigned char>(text[i]) : static_cast<unsigned char>(0);
  };
  const unsigned char first = byte(0);
  const unsigned char second = byte(1);
  if (first < 0x80) return 1;
  if (first < 0xC2 || first > 0xF4 || !continues(second)) return 0;
  if (first < 0xE0) return 2;
  if (!continues(byte(2))) return 0;
  if (first < 0xF0) {
    const bool overlong = first == 0xE0 && second < 0xA0;
    const bool surrogate = first == 0xED && second >= 0xA0;
    return overlong || surrogate ? 0 : 3;
  }
  if (!continues(byte(3))) return 0;
  const bool overlong = first == 0xF0 && second < 0x90;
  const bool too_large = first == 0xF4 && second >= 0x90;
  return overlong || too_large ? 0 : 4;
}

bool is_control(char character) noexcept {
  const auto byte = static_cast<unsigned char>(character);
  return byte < 0x20 || byte == 0x7F;
}

void select(cairo_t* context, const Font& font) noexcept {
  cairo_select_font_face(context, "sans-serif", CAIRO_FONT_SLANT_NORMAL,
                         font.bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(context, font.size);
  // Grey edges and unhinted widths, independent of desktop settings.
  cairo_font_options_t* options = cairo_font_options_create();
  cairo_font_options_set_antialias(options, CAIRO_ANTIALIAS_GRAY);
  cairo_font_options_set_hint_style(options, CAIRO_HINT_STYLE_NONE);
  cairo_font_options_set_hint_metrics(options, CAIRO_HINT_METRICS_OFF);
  cairo_set_font_options(context, options);
  cairo_font_options_destroy(options);
}

// If the system has no font, Cairo uses its built-in stroke font, which supports only ASCII. `room`
// then stores the replaced text. Without memory for it, other characters appear as boxes.
const char* shown(cairo_t* context, const std::string& text, std::string& room) noexcept try {
  if (cairo_scaled_font_get_type(cairo_get_scaled_font(context)) != CAIRO_FONT_TYPE_USER) {
    return text.c_str();
  }
  using Pair = std::pair<std::string_view, std::string_view>;
  room = text;
  for (const auto& [sign, ascii] : {Pair("\u2212", "-"), Pair("\u2026", "...")}) {
    for (std::size_t at = 0; (at = room.find(sign, at)) != std::string::npos;) {
      room.replace(at, sign.size(), ascii);
    }
  }
  return room.c_str();
} catch (const std::bad_alloc&) {
  return text.c_str();
}

double aligned_left(cairo_t* context, double x, const std::string& text, const Font& font,
                    Align align) noexcept {
  switch (align) {
    case Align::left: return x;
    case Align::center: return x - text_width(context, text, font) / 2;
    case Align::right: return x - text_width(context, text, font);
  }
  return x;
}

// The first `head` and last `tail` bytes, reduced to whole characters.
std::string without_middle(const std::string& text, std::size_t head, std::size_t tail) {
  while (head > 0 && continues(static_cast<unsigned char>(text[head]))) --head;
  std::size_t resume = text.size() - tail;
  while (resume < text.size() && continues(static_cast<unsigned char>(text[resume]))) ++resume;
  return text.substr(0, head) + "\u2026" + text.substr(resume);
}

}  // namespace

std::string printable(std::string_view text) {
  std::string clean;
  clean.reserve(text.size());
  while (!text.empty()) {
    const std::size_t length = character_length(text);
    if (length == 0 || is_control(text.front())) {
      clean += '?';
      text.remove_prefix(1);
    } else {
      clean += text.substr(0, length);
      text.remove_prefix(length);
    }
  }
  return clean;
}

double text_width(cairo_t* context, const std::string& text, const Font& font) noexcept {
  select(context, font);
  cairo_text_extents_t extents;
  std::string room;
  cairo_text_extents(context, shown(context, text, room), &extents);
  return extents.x_advance;
}

std::string fitted(cairo_t* context, std::string_view text, const Font& font, double width) {
  // More does not fit into any image; the limit bounds the search below.
  constexpr std::size_t longest = 4096;
  std::string whole = printable(text.substr(0, longest));
  if (text_width(context, whole, font) <= width) return whole;

  std::size_t fits = 0;
  std::size_t too_long = whole.size();
  while (too_long - fits > 1) {
    const std::size_t kept = fits + (too_long - fits) / 2;
    const std::string candidate = without_middle(whole, kept - kept / 2, kept / 2);
    (text_width(context, candidate, font) <= width ? fits : too_long) = kept;
  }
  return without_middle(whole, fits - fits / 2, fits / 2);
}

Font shrunk(cairo_t* context, const std::string& text, Font font, double width) noexcept {
  font.size *= std::min(1.0, width / std::max(1.0, text_width(context, text, font)));
  return font;
}

void draw_text(cairo_t* context, double x, double baseline, const std::string& text,
               const Font& font, Align align) noexcept {
  const double left = aligned_left(context, x, text, font, align);
  select(context, font);
  set_color(context, font.color);
  cairo_move_to(context, left, baseline);
  std::string room;
  cairo_show_text(context, shown(context, text, room));
  cairo_new_path(context);
}

void draw_edged_text(cairo_t* context, double x, double baseline, const std::string& text,
                     const Font& font, Color edge, Align align) noexcept {
  const double left = aligned_left(context, x, text, font, align);
  select(context, font);
  cairo_move_to(context, left, baseline);
  std::string room;
  cairo_text_path(context, shown(context, text, room));
  cairo_set_line_width(context, font.size / 3.5);
  cairo_set_line_join(context, CAIRO_LINE_JOIN_ROUND);
  set_color(context, edge, 0.85);
  cairo_stroke(context);
  draw_text(context, left, baseline, text, font);
}

void draw_backing(cairo_t* context, const Rectangle& box, double unit, Color color) noexcept {
  add_rectangle(context, box, 8 * unit);
  set_color(context, color, 0.86);
  cairo_fill(context);
}

std::string grouped(std::size_t count) {
  std::string digits = std::to_string(count);
  for (std::size_t place = digits.size(); place > 3; place -= 3) digits.insert(place - 3, 1, ',');
  return digits;
}

std::string percent(std::size_t part, std::size_t whole) {
  const double share =
      whole == 0 ? 0 : 100 * static_cast<double>(part) / static_cast<double>(whole);
  if (part != 0 && share < 0.05) return "<0.1 %";
  return fmt::format("{:.1f} %", share);
}

void draw_heading(const Canvas& canvas, const Rectangle& heading, double unit,
                  std::string_view title, std::string_view subtitle) {
  cairo_t* context = canvas.context();
  const auto& [x, y, width, height] = heading;
  const Font title_font{.size = 36 * unit, .bold = true, .color = text_color};
  const Font subtitle_font{.size = 26 * unit, .bold = false, .color = muted_text_color};
  draw_text(context, x, y + 28 * unit, fitted(context, title, title_font, width), title_font);
  draw_text(context, x, y + 66 * unit, fitted(context, subtitle, subtitle_font, width),
            subtitle_font);
}

}  // namespace flagstone::render
