// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "files/render/points.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <vector>

#include "files/render/text.hpp"
#include "files/render/zone_layer.hpp"

namespace flagstone::render {
namespace {

enum Outcome : std::uint8_t {
  true_positive,
  false_negative,
  false_positive,
  true_negative,
  not_scored,
};

Outcome outcome(Label label, Truth truth) noexcept {
  if (truth == Truth::ignored) return not_scored;
  if (truth == Truth::ground) return label == Label::ground ? true_positive : false_negative;
  return label == Label::ground ? false_positive : true_negative;
}

void add_point(PointKinds& points, Label label, std::uint8_t kind) {
  points.of_point.push_back(label == Label::invalid ? PointKinds::nowhere : kind);
  ++points.kinds[kind].count;
}

}  // namespace

PointKinds kinds_by_label(std::span<const Label> labels) {
  PointKinds points;
  // Yellow and cyan as in Fig. 7 of the paper.
  points.kinds = {
      {.name = "ground", .color = {246, 201, 58}, .size = 1, .drawn = true},
      {.name = "non-ground", .color = {58, 196, 226}, .size = 1, .drawn = true},
      {.name = "noise", .color = {214, 104, 158}, .size = 1.3, .drawn = true},
      {.name = "out of range", .color = {112, 121, 133}, .size = 1, .drawn = true},
      {.name = "invalid (hidden)", .color = {112, 121, 133}, .size = 1, .drawn = false},
  };
  points.drawing_order = {3, 0, 1, 2};
  points.of_point.reserve(labels.size());
  constexpr std::array<std::uint8_t, label_count> kind_of_code = {1, 0, 2, 3, 4};
  for (const Label label : labels)
    add_point(points, label, kind_of_code[static_cast<std::size_t>(label)]);
  return points;
}

PointKinds kinds_by_truth(std::span<const Label> labels, std::span<const Truth> reference) {
  PointKinds points;
  // Errors are larger, so that they are visible among many correct points and to readers who cannot
  // distinguish red from green.
  points.kinds = {
      {.name = "true positive", .color = {44, 166, 96}, .size = 1, .drawn = true},
      {.name = "false negative", .color = {66, 140, 255}, .size = 1.5, .drawn = true},
      {.name = "false positive", .color = {255, 72, 56}, .size = 1.5, .drawn = true},
      {.name = "true negative", .color = {140, 148, 158}, .size = 1, .drawn = true},
      {.name = "not scored", .color = {70, 77, 87}, .size = 1, .drawn = true},
  };
  points.drawing_order = {not_scored, true_positive, true_negative, false_negative, false_positive};
  points.of_point.reserve(reference.size());
  for (std::size_t i = 0; i < reference.size(); ++i)
    add_point(points, labels[i], outcome(labels[i], reference[i]));
  return points;
}

namespace {

// The pixels that points may change: from `left` and `top` up to but excluding `right` and
// `bottom`.
struct Window {
  int left, top, right, bottom;
};

Window window_of(const Rectangle& panel) noexcept {
  return {.left = static_cast<int>(std::ceil(panel.x)),
          .top = static_cast<int>(std::ceil(panel.y)),
          .right = static_cast<int>(std::floor(panel.right())),
          .bottom = static_cast<int>(std::floor(panel.bottom()))};
}

// Halves round up, which is the same on every platform.
std::uint32_t mixed(std::uint32_t below, std::uint32_t above, std::uint32_t opacity) noexcept {
  return (below * (255 - opacity) + above * opacity + 127) / 255;
}

std::uint32_t mixed(std::uint32_t pixel, Color color, std::uint32_t opacity) noexcept {
  const std::uint32_t red = mixed((pixel >> 16) & 0xFF, color.red, opacity);
  const std::uint32_t green = mixed((pixel >> 8) & 0xFF, color.green, opacity);
  const std::uint32_t blue = mixed(pixel & 0xFF, color.blue, opacity);
  return red << 16 | green << 8 | blue;
}

// In pixels of the default image size. Sparse scans get larger points, to keep them visible.
double point_radius(std::size_t count) noexcept {
  constexpr double dense_scan = 120'000;
  const double sparseness = dense_scan / static_cast<double>(std::max<std::size_t>(count, 1));
  return std::clamp(0.9 * std::pow(sparseness, 0.25), 0.7, 5.0);
}

class DiscPainter {
 public:
  DiscPainter(Canvas::Pixels pixels, const Window& window) noexcept
      : pixels_(pixels), window_(window) {}

  // A disc with soft edges: coverage decreases from 1 to 0 over one pixel at the edge.
  void paint(double column, double row, double radius, Color color) const noexcept {
    const double reach = radius + 0.5;
    const int first_row = std::max(window_.top, static_cast<int>(std::floor(row - reach)));
    const int last_row = std::min(window_.bottom - 1, static_cast<int>(std::floor(row + reach)));
    const int first_column = std::max(window_.left, static_cast<int>(std::floor(column - reach)));
    const int last_column =
        std::min(window_.right - 1, static_cast<int>(std::floor(column + reach)));
    for (int y = first_row; y <= last_row; ++y) {
      for (int x = first_column; x <= last_column; ++x) {
        const double distance_x = x + 0.5 - column;
        const double distance_y = y + 0.5 - row;
        const double distance = std::sqrt(distance_x * distance_x + distance_y * distance_y);
        const double cover = std::clamp(reach - distance, 0.0, 1.0);
        auto& pixel = pixels_.data[static_cast<std::size_t>(y) * pixels_.row_length +
                                   static_cast<std::size_t>(x)];
        pixel = mixed(pixel, color, static_cast<std::uint32_t>(std::lround(255 * cover)));
      }
    }
  }

 private:
  Canvas::Pixels pixels_;
  Window window_;
};

// False also for values that are not finite, so check this before converting to integer pixels.
bool contains(const Rectangle& panel, double column, double row) noexcept {
  return column >= panel.x && column < panel.right() && row >= panel.y && row < panel.bottom();
}

}  // namespace

std::size_t draw_points(const Canvas& canvas, const TopView& view, CloudView cloud,
                        const PointKinds& points, double unit) {
  const DiscPainter painter(canvas.begin_pixels(), window_of(view.panel()));
  const double radius = unit * point_radius(cloud.size());
  std::size_t beyond = 0;
  for (const std::uint8_t kind : points.drawing_order) {
    const PointKind& look = points.kinds[kind];
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      if (points.of_point[i] != kind) continue;
      const Point point = cloud[i];
      const double column = view.column(point.y);
      const double row = view.row(point.x);
      if (contains(view.panel(), column, row))
        painter.paint(column, row, radius * look.size, look.color);
      else
        ++beyond;
    }
  }
  canvas.end_pixels();
  return beyond;
}

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

// A square in the colour of a tinted bin on the panel, with an edge in the pure colour.
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
      fmt::format("{} {} outside the view", grouped(beyond), beyond == 1 ? "point" : "points");
  const double width = text_width(context, note, font) + 32 * unit;
  const Rectangle box{layout.panel.center_x() - width / 2, layout.panel.bottom() - 56 * unit, width,
                      40 * unit};
  draw_backing(context, box, unit, panel_color);
  draw_text(context, box.center_x(), box.y + 27 * unit, note, font, Align::center);
}

}  // namespace flagstone::render
