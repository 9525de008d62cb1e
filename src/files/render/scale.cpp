// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "files/render/scale.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "files/render/text.hpp"
#include "library/core/statistics.hpp"

namespace flagstone::render {
namespace {

constexpr double widest = 1000;

std::vector<double> distances(CloudView cloud, std::span<const Label> labels) {
  std::vector<double> all;
  all.reserve(cloud.size());
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Point point = cloud[i];
    const double distance = std::hypot(double{point.x}, double{point.y});
    if (labels[i] != Label::invalid && std::isfinite(distance)) all.push_back(distance);
  }
  return all;
}

}  // namespace

double suitable_range(CloudView cloud, std::span<const Label> labels,
                      const PatchworkConfig* zones) {
  const double bound = zones != nullptr ? double{zones->zones.back().ring_radii.back()} : widest;
  std::vector<double> all = distances(cloud, labels);
  if (all.empty()) return zones != nullptr ? bound : 50;
  return std::min(bound, std::max(10.0, 10 * std::ceil(percentile(all, 98) / 10)));
}

double ring_step(double range) noexcept {
  const double largest = range / 3;
  const double power = std::pow(10, std::floor(std::log10(largest)));
  if (5 * power <= largest) return 5 * power;
  if (2 * power <= largest) return 2 * power;
  return power;
}

std::vector<double> circle_radii(double range, const PatchworkConfig* zones) {
  std::vector<double> radii;
  if (zones != nullptr) {
    radii.push_back(zones->min_range);
    for (const Zone& zone : zones->zones) radii.push_back(zone.ring_radii.back());
    return radii;
  }
  const double step = ring_step(range);
  for (int ring = 1; ring * step < 2 * range; ++ring) radii.push_back(ring * step);
  return radii;
}

namespace {

// Decimals of the captions: 1 for all if any distance needs it.
int decimals(std::span<const double> distances) noexcept {
  const auto is_whole = [](double distance) noexcept {
    return std::abs(distance - std::round(distance)) < 0.05;
  };
  return std::ranges::all_of(distances, is_whole) ? 0 : 1;
}

// Captions are ahead and to the right, where a straight road has the fewest points. Captions that
// would touch the mark of the sensor, another caption or the edge of the panel are omitted.
void draw_captions(cairo_t* context, const TopView& view, std::span<const double> radii,
                   double unit, const PanelInk& ink) {
  const Font font{.size = 22 * unit, .bold = false, .color = ink.ink};
  const int places = decimals(radii);
  double last = view.panel().center_x();
  for (const double radius : radii) {
    const double along = radius / std::numbers::sqrt2;
    const double column = view.column(-along);
    const double row = view.row(along);
    if (column - last < 40 * unit) continue;
    if (column > view.panel().right() - 60 * unit || row < view.panel().y + 40 * unit) return;
    draw_edged_text(context, column, row + font.size * 0.36,
                    fmt::format("{:.{}f} m", radius, places), font, ink.backing, Align::center);
    last = column;
  }
}

void draw_arrow(cairo_t* context, double x, double y, double to_x, double to_y,
                double unit) noexcept {
  const double length = std::hypot(to_x - x, to_y - y);
  const double along_x = (to_x - x) / length;
  const double along_y = (to_y - y) / length;
  const double head = 15 * unit;
  const double half = 7 * unit;
  cairo_move_to(context, x, y);
  cairo_line_to(context, to_x - along_x * head, to_y - along_y * head);
  cairo_set_line_width(context, 3 * unit);
  cairo_stroke(context);
  cairo_move_to(context, to_x, to_y);
  cairo_line_to(context, to_x - along_x * head - along_y * half,
                to_y - along_y * head + along_x * half);
  cairo_line_to(context, to_x - along_x * head + along_y * half,
                to_y - along_y * head - along_x * half);
  cairo_close_path(context);
  cairo_fill(context);
}

void draw_axes(cairo_t* context, const Rectangle& panel, double unit, const PanelInk& ink) {
  const Rectangle box{panel.x + 16 * unit, panel.bottom() - 146 * unit, 222 * unit, 130 * unit};
  draw_backing(context, box, unit, ink.backing);
  const Font font{.size = 22 * unit, .bold = false, .color = ink.ink};
  const double x = box.x + 84 * unit;
  const double y = box.bottom() - 44 * unit;
  set_color(context, ink.ink);
  draw_arrow(context, x, y, x, y - 70 * unit, unit);
  draw_arrow(context, x, y, x - 70 * unit, y, unit);
  draw_text(context, x + 14 * unit, y - 54 * unit, "x forward", font);
  draw_text(context, box.x + 14 * unit, y + 30 * unit, "y left", font);
}

void draw_scale_bar(cairo_t* context, const TopView& view, double range, double unit,
                    const PanelInk& ink) {
  const double step = ring_step(range);
  const double length = step * view.pixels_per_metre();
  const Rectangle& panel = view.panel();
  const Rectangle box{panel.right() - length - 56 * unit, panel.bottom() - 86 * unit,
                      length + 40 * unit, 70 * unit};
  draw_backing(context, box, unit, ink.backing);
  draw_bar(context, box.x + 20 * unit, box.bottom() - 20 * unit, length,
           fmt::format("{:g} m", step), unit, ink.ink);
}

}  // namespace

void draw_bar(cairo_t* context, double left, double line, double length, const std::string& text,
              double unit, Color color) {
  const double right = left + length;
  for (const double end : {left, right}) {
    cairo_move_to(context, end, line - 8 * unit);
    cairo_line_to(context, end, line + 8 * unit);
  }
  cairo_move_to(context, left, line);
  cairo_line_to(context, right, line);
  cairo_set_line_cap(context, CAIRO_LINE_CAP_SQUARE);
  cairo_set_line_width(context, 3 * unit);
  set_color(context, color);
  cairo_stroke(context);
  const Font font{.size = 22 * unit, .bold = false, .color = color};
  draw_text(context, (left + right) / 2, line - 14 * unit, text, font, Align::center);
}

void draw_range_rings(const Canvas& canvas, const TopView& view, std::span<const double> radii,
                      double unit) noexcept {
  cairo_t* context = canvas.context();
  cairo_save(context);
  add_rectangle(context, view.panel());
  cairo_clip(context);
  for (const double radius : radii) {
    cairo_new_sub_path(context);
    cairo_arc(context, view.panel().center_x(), view.panel().center_y(),
              radius * view.pixels_per_metre(), 0, 2 * std::numbers::pi);
  }
  const std::array<double, 2> dash = {7 * unit, 7 * unit};
  cairo_set_dash(context, dash.data(), static_cast<int>(dash.size()), 0);
  cairo_set_line_width(context, 1.5 * unit);
  set_color(context, range_ring_color, 0.55);
  cairo_stroke(context);
  cairo_restore(context);
}

void draw_sensor(const Canvas& canvas, const TopView& view, double unit) noexcept {
  cairo_t* context = canvas.context();
  const double x = view.panel().center_x();
  const double y = view.panel().center_y();
  cairo_move_to(context, x, y - 17 * unit);
  cairo_line_to(context, x + 12 * unit, y + 14 * unit);
  cairo_line_to(context, x, y + 8 * unit);
  cairo_line_to(context, x - 12 * unit, y + 14 * unit);
  cairo_close_path(context);
  cairo_set_line_join(context, CAIRO_LINE_JOIN_ROUND);
  cairo_set_line_width(context, 5 * unit);
  set_color(context, panel_color);
  cairo_stroke_preserve(context);
  set_color(context, page_color);
  cairo_fill(context);
}

void draw_scale(const Canvas& canvas, const TopView& view, double range,
                std::span<const double> radii, double unit, const PanelInk& ink) {
  cairo_t* context = canvas.context();
  cairo_save(context);
  add_rectangle(context, view.panel());
  cairo_clip(context);
  draw_captions(context, view, radii, unit, ink);
  draw_sensor(canvas, view, unit);
  draw_axes(context, view.panel(), unit, ink);
  draw_scale_bar(context, view, range, unit, ink);
  cairo_restore(context);
}

}  // namespace flagstone::render
