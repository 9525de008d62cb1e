// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "files/render/legend.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <numbers>
#include <string>
#include <vector>

#include "files/render/number_text.hpp"
#include "files/render/text.hpp"
#include "files/render/zone_layer.hpp"

namespace flagstone::render {
namespace {

enum class Swatch : std::uint8_t { disc, ring, tint };

struct Entry {
  Swatch swatch;
  Color color;
  const char* name;
  std::string numbers;
};

std::string numbers(std::size_t part, std::size_t whole) {
  return grouped(part) + "   " + percent(part, whole);
}

std::vector<Entry> point_entries(const PointKinds& points) {
  std::vector<Entry> entries;
  entries.reserve(points.kinds.size());
  for (const PointKind& kind : points.kinds)
    entries.push_back({kind.drawn ? Swatch::disc : Swatch::ring, kind.color, kind.name,
                       numbers(kind.count, points.of_point.size())});
  return entries;
}

std::vector<Entry> patch_entries(std::span<const Patch> patches) {
  std::vector<Entry> entries;
  entries.reserve(verdict_looks().size());
  for (const VerdictLook& look : verdict_looks()) {
    const auto count = std::ranges::count(patches, look.verdict, &Patch::verdict);
    entries.push_back({Swatch::tint, look.color, look.name,
                       numbers(static_cast<std::size_t>(count), patches.size())});
  }
  return entries;
}

// A square in the colour that a tinted bin has on the panel, edged in the pure one.
void draw_tint(cairo_t* context, const Rectangle& square, Color color, double unit) noexcept {
  add_rectangle(context, square, 3 * unit);
  set_color(context, panel_color);
  cairo_fill_preserve(context);
  set_color(context, color, tint_opacity);
  cairo_fill_preserve(context);
  set_color(context, color);
  cairo_stroke(context);
}

void draw_swatch(cairo_t* context, const Entry& entry, double x, double y, double unit) noexcept {
  const double radius = 10 * unit;
  cairo_new_path(context);
  cairo_set_line_width(context, 2.5 * unit);
  if (entry.swatch == Swatch::tint)
    return draw_tint(context, {x - radius, y - radius, 2 * radius, 2 * radius}, entry.color, unit);
  cairo_arc(context, x, y, radius, 0, 2 * std::numbers::pi);
  set_color(context, entry.color);
  entry.swatch == Swatch::ring ? cairo_stroke(context) : cairo_fill(context);
}

void draw_row(cairo_t* context, const Rectangle& row, const std::string& caption,
              const std::vector<Entry>& entries, std::size_t columns, double unit) {
  const Font caption_font{.size = 24 * unit, .bold = true, .color = text_color};
  const Font name_font{.size = 24 * unit, .bold = false, .color = text_color};
  const Font number_font{.size = 22 * unit, .bold = false, .color = muted_text_color};
  const double name_line = row.y + 26 * unit;
  const double number_line = row.y + 56 * unit;
  const double caption_width = 134 * unit;
  const double column_width = (row.width - caption_width) / static_cast<double>(columns);
  const double text_indent = 34 * unit;

  draw_text(context, row.x, name_line, caption, caption_font);
  double x = row.x + caption_width;
  for (const Entry& entry : entries) {
    draw_swatch(context, entry, x + 11 * unit, name_line - 9 * unit, unit);
    draw_text(context, x + text_indent, name_line, entry.name, name_font);
    draw_text(context, x + text_indent, number_line, entry.numbers,
              shrunk(context, entry.numbers, number_font, column_width - 1.5 * text_indent));
    x += column_width;
  }
}

}  // namespace

void draw_legend(const Canvas& canvas, const Layout& layout, const PointKinds& points,
                 std::span<const Patch> patches, bool tinted) {
  Rectangle row = layout.legend;
  const std::vector<Entry> kinds = point_entries(points);
  const std::vector<Entry> verdicts = tinted ? patch_entries(patches) : std::vector<Entry>();
  const std::size_t columns = std::max(kinds.size(), verdicts.size());
  draw_row(canvas.context(), row, "Points", kinds, columns, layout.unit);
  if (!tinted) return;
  row.y += legend_row_height * layout.unit;
  draw_row(canvas.context(), row, "Patches", verdicts, columns, layout.unit);
}

void draw_kind_names(const Canvas& canvas, const Rectangle& legend, double unit,
                     const PointKinds& points, const std::string& note) {
  std::vector<Entry> kinds = point_entries(points);
  for (Entry& kind : kinds) kind.numbers.clear();
  draw_row(canvas.context(), legend, "Points", kinds, kinds.size(), unit);
  const Font font{.size = 22 * unit, .bold = false, .color = muted_text_color};
  draw_text(canvas.context(), legend.x, legend.y + 62 * unit, note, font);
}

void draw_beyond_note(const Canvas& canvas, const Layout& layout, std::size_t beyond) {
  if (beyond == 0) return;
  cairo_t* context = canvas.context();
  const double unit = layout.unit;
  const Font font{.size = 20 * unit, .bold = false, .color = panel_text_color};
  const std::string note =
      fmt::format("{} {} beyond the frame", grouped(beyond), beyond == 1 ? "point" : "points");
  const double width = text_width(context, note, font) + 32 * unit;
  const Rectangle box{layout.panel.center_x() - width / 2, layout.panel.bottom() - 56 * unit, width,
                      40 * unit};
  draw_backing(context, box, unit, panel_color);
  draw_text(context, box.center_x(), box.y + 27 * unit, note, font, Align::center);
}

}  // namespace flagstone::render
