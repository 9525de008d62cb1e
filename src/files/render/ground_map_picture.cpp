// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "files/render/ground_map_picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <new>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "files/io/atomic_file.hpp"
#include "files/render/canvas.hpp"
#include "files/render/contours.hpp"
#include "files/render/relief.hpp"
#include "files/render/scale.hpp"
#include "files/render/text.hpp"
#include "library/core/statistics.hpp"

namespace flagstone::render {
namespace {

constexpr float unknown = std::numeric_limits<float>::quiet_NaN();
constexpr Color path_color{28, 62, 148};
constexpr Color start_color{0, 132, 92};
constexpr Color end_color{196, 44, 52};

/// The rectangle that an image shows, metres.
struct Bounds {
  double min_x = std::numeric_limits<double>::infinity();
  double max_x = -std::numeric_limits<double>::infinity();
  double min_y = std::numeric_limits<double>::infinity();
  double max_y = -std::numeric_limits<double>::infinity();

  [[nodiscard]] bool empty() const noexcept { return min_x > max_x; }
  [[nodiscard]] double width() const noexcept { return max_x - min_x; }
  [[nodiscard]] double height() const noexcept { return max_y - min_y; }
  void include(double x, double y) noexcept {
    min_x = std::min(min_x, x);
    max_x = std::max(max_x, x);
    min_y = std::min(min_y, y);
    max_y = std::max(max_y, y);
  }
};

/// A grid with interpolation between the centres of its cells.
class Ground {
 public:
  explicit Ground(const GroundGrid& grid)
      : grid_(grid), rows_(grid.heights.size() / grid.columns) {}

  [[nodiscard]] double cell() const noexcept { return grid_.cell; }

  /// Bilinear height; NaN if the known cells have at most half of the weight.
  [[nodiscard]] float height(double x, double y) const noexcept {
    const double column = (x - grid_.min_x) / grid_.cell - 0.5;
    const double row = (y - grid_.min_y) / grid_.cell - 0.5;
    const double first_column = std::floor(column);
    const double first_row = std::floor(row);
    double sum = 0;
    double known = 0;
    for (const double right : {0.0, 1.0}) {
      for (const double up : {0.0, 1.0}) {
        const float corner = at(first_column + right, first_row + up);
        if (!std::isfinite(corner)) continue;
        const double weight =
            std::abs(1 - right - (column - first_column)) * std::abs(1 - up - (row - first_row));
        sum += weight * double{corner};
        known += weight;
      }
    }
    return known > 0.5 ? static_cast<float>(sum / known) : unknown;
  }

  /// The mean height within `reach` metres along both axes, for contour lines, which would
  /// otherwise follow the errors of single cells. NaN if the height at (x, y) is unknown.
  [[nodiscard]] float smoothed_height(double x, double y, double reach) const noexcept {
    if (std::isnan(height(x, y))) return unknown;
    constexpr int taps = 2;  // to each side
    double sum = 0;
    int known = 0;
    for (int up = -taps; up <= taps; ++up) {
      for (int right = -taps; right <= taps; ++right) {
        const float tap = height(x + right * reach / taps, y + up * reach / taps);
        if (std::isnan(tap)) continue;
        sum += double{tap};
        ++known;
      }
    }
    return static_cast<float>(sum / known);
  }

  [[nodiscard]] double rise_x(double x, double y, double here) const noexcept {
    return slope(height(x - cell(), y), here, height(x + cell(), y), cell());
  }
  [[nodiscard]] double rise_y(double x, double y, double here) const noexcept {
    return slope(height(x, y - cell()), here, height(x, y + cell()), cell());
  }

  /// Outer limits of the known cells.
  [[nodiscard]] Bounds known_bounds() const noexcept {
    Bounds bounds;
    for (std::size_t k = 0; k < grid_.heights.size(); ++k) {
      if (!std::isfinite(grid_.heights[k])) continue;
      const double x = grid_.min_x + static_cast<double>(k % grid_.columns) * grid_.cell;
      const std::size_t row = k / grid_.columns;
      const double y = grid_.min_y + static_cast<double>(row) * grid_.cell;
      bounds.include(x, y);
      bounds.include(x + grid_.cell, y + grid_.cell);
    }
    return bounds;
  }

  /// Colours that span nearly all heights, and shading that shows gentle slopes.
  [[nodiscard]] ReliefLook look() const {
    std::vector<double> heights;
    std::vector<double> steepness;
    constexpr std::size_t most_samples = 200'000;
    const std::size_t apart = 1 + grid_.heights.size() / most_samples;
    for (std::size_t k = 0; k < grid_.heights.size(); k += apart) {
      if (!std::isfinite(grid_.heights[k])) continue;
      const double x = grid_.min_x + (static_cast<double>(k % grid_.columns) + 0.5) * grid_.cell;
      const std::size_t row = k / grid_.columns;
      const double y = grid_.min_y + (static_cast<double>(row) + 0.5) * grid_.cell;
      const auto here = double{grid_.heights[k]};
      heights.push_back(here);
      steepness.push_back(std::hypot(rise_x(x, y, here), rise_y(x, y, here)));
    }
    if (heights.empty()) return suitable_look({-1, 1}, 0);
    return suitable_look({percentile(heights, 2), percentile(heights, 98)},
                         percentile(steepness, 85));
  }

 private:
  [[nodiscard]] float at(double column, double row) const noexcept {
    const bool is_inside = column >= 0 && column < static_cast<double>(grid_.columns) && row >= 0 &&
                           row < static_cast<double>(rows_);
    if (!is_inside) return unknown;
    return grid_
        .heights[static_cast<std::size_t>(row) * grid_.columns + static_cast<std::size_t>(column)];
  }

  GroundGrid grid_;
  std::size_t rows_;
};

Bounds shown_bounds(const Ground& ground, std::span<const MapPosition> path) noexcept {
  Bounds bounds = ground.known_bounds();
  for (const auto& [x, y] : path) {
    if (std::isfinite(x) && std::isfinite(y)) bounds.include(x, y);
  }
  if (bounds.empty()) bounds.include(0, 0);
  const double margin = std::max(5.0, 0.02 * std::max(bounds.width(), bounds.height()));
  bounds.include(bounds.min_x - margin, bounds.min_y - margin);
  bounds.include(bounds.max_x + margin, bounds.max_y + margin);
  return bounds;
}

/// Positions of the parts of an image.
struct MapLayout {
  int width, height;  // of the image, pixels
  double unit;
  Rectangle heading, panel, legend;
};

MapLayout arrange_map(int width, double panel_aspect, int max_height) noexcept {
  constexpr double default_width = 1600;
  constexpr double least_aspect = 0.16;  // height / width, so that long streets have a legible map
  const double unit = width / default_width;
  const double margin = std::round(40 * unit);
  const double heading_height = std::round(92 * unit);
  const double legend_height = std::round(64 * unit);
  const double left = std::round(128 * unit);  // coordinates of y
  const double below = std::round(84 * unit);  // coordinates of x
  const double panel_top = margin + heading_height;
  const double panel_width = width - left - margin;
  const double rest = panel_top + below + legend_height + margin;
  const double panel_height =
      std::round(std::min(panel_width * std::max(panel_aspect, least_aspect), max_height - rest));
  return {.width = width,
          .height = static_cast<int>(rest + panel_height),
          .unit = unit,
          .heading = {margin, margin, width - 2 * margin, heading_height},
          .panel = {left, panel_top, panel_width, panel_height},
          .legend = {margin, panel_top + panel_height + below, width - 2 * margin, legend_height}};
}

/// The largest image that is not wider than the map needs. Images of narrow, high maps are at least
/// half as wide as high, which the legend needs.
MapLayout suitable_layout(const Bounds& bounds, double cell, int max_size) noexcept {
  constexpr double most_pixels_per_cell = 8;
  const double aspect = bounds.height() / bounds.width();
  const double largest = std::max(bounds.width(), bounds.height()) / cell * most_pixels_per_cell;
  const int size =
      std::clamp(static_cast<int>(std::min(largest, 1e6)), std::min(max_size, 1200), max_size);
  MapLayout layout = arrange_map(size, aspect, size);
  while (layout.panel.height < layout.panel.width * aspect && layout.width > size / 2) {
    layout = arrange_map(layout.width - 8, aspect, size);
  }
  return layout;
}

/// The positions of a map in a panel: x to the right, y up.
class MapView {
 public:
  MapView(const Rectangle& panel, const Bounds& bounds) noexcept
      : panel_(panel),
        center_x_((bounds.min_x + bounds.max_x) / 2),
        center_y_((bounds.min_y + bounds.max_y) / 2),
        scale_(std::min(panel.width / bounds.width(), panel.height / bounds.height())) {}

  [[nodiscard]] const Rectangle& panel() const noexcept { return panel_; }
  [[nodiscard]] double pixels_per_metre() const noexcept { return scale_; }
  [[nodiscard]] double column(double x) const noexcept {
    return panel_.center_x() + scale_ * (x - center_x_);
  }
  [[nodiscard]] double row(double y) const noexcept {
    return panel_.center_y() - scale_ * (y - center_y_);
  }
  [[nodiscard]] double x(double column) const noexcept {
    return center_x_ + (column - panel_.center_x()) / scale_;
  }
  [[nodiscard]] double y(double row) const noexcept {
    return center_y_ - (row - panel_.center_y()) / scale_;
  }

 private:
  Rectangle panel_;
  double center_x_, center_y_, scale_;
};

void draw_relief(const Canvas& canvas, const MapView& view, const Ground& ground,
                 const ReliefLook& look) {
  const Rectangle& panel = view.panel();
  const auto width = static_cast<std::size_t>(panel.width);
  const auto height = static_cast<std::size_t>(panel.height);
  std::vector<std::uint32_t> pixels(width * height);
  for (std::size_t row = 0; row < height; ++row) {
    const double y = view.y(panel.y + static_cast<double>(row) + 0.5);
    for (std::size_t column = 0; column < width; ++column) {
      const double x = view.x(panel.x + static_cast<double>(column) + 0.5);
      const auto here = double{ground.height(x, y)};
      if (std::isnan(here)) continue;
      pixels[row * width + column] =
          relief_pixel(here, ground.rise_y(x, y, here), -ground.rise_x(x, y, here), look);
    }
  }
  paint_relief(canvas, panel, {.pixels = pixels, .width = width},
               {.x = panel.x, .y = panel.y, .pixels_per_sample = 1});
}

void draw_contour_lines(const Canvas& canvas, const MapView& view, const Ground& ground,
                        const ReliefLook& look, double unit) {
  constexpr double samples_apart = 4;  // pixels
  const Rectangle& panel = view.panel();
  const auto width = static_cast<std::size_t>(panel.width / samples_apart);
  const auto height = static_cast<std::size_t>(panel.height / samples_apart);
  const double reach = std::max(2 * ground.cell(), samples_apart / view.pixels_per_metre());
  std::vector<float> heights(width * height);
  const auto place = [](double corner, std::size_t sample) {
    return corner + (static_cast<double>(sample) + 0.5) * samples_apart;
  };
  for (std::size_t row = 0; row < height; ++row) {
    for (std::size_t column = 0; column < width; ++column) {
      heights[row * width + column] = ground.smoothed_height(view.x(place(panel.x, column)),
                                                             view.y(place(panel.y, row)), reach);
    }
  }
  ContourGrid grid{.heights = heights, .width = width, .to_pixels = {}};
  cairo_matrix_init(&grid.to_pixels, samples_apart, 0, 0, samples_apart, place(panel.x, 0),
                    place(panel.y, 0));
  const double span = look.heights.span();  // bounds the number of lines
  draw_contours(canvas, panel, grid, {look.heights.lowest - span, look.heights.highest + span},
                look.step, unit);
}

void draw_mark(cairo_t* context, double x, double y, Color color, const char* name, Align side,
               double unit) {
  const double radius = 11 * unit;
  cairo_new_sub_path(context);
  cairo_arc(context, x, y, radius, 0, 2 * std::numbers::pi);
  set_color(context, color);
  cairo_fill_preserve(context);
  cairo_set_line_width(context, 4 * unit);
  set_color(context, page_color);
  cairo_stroke(context);
  const double apart = side == Align::left ? 1.6 * radius : -1.6 * radius;
  draw_edged_text(context, x + apart, y + 8 * unit, name,
                  {.size = 24 * unit, .bold = true, .color = color}, page_color, side);
}

/// The path of the sensor. Its line is below the contour lines, so that their labels are legible;
/// the marks are above them.
class PathDrawing {
 public:
  PathDrawing(const Canvas& canvas, const MapView& view, std::span<const MapPosition> path,
              double unit) noexcept
      : context_(canvas.context()), view_(view), path_(path), unit_(unit) {}

  void draw_line() noexcept {
    begin();
    trace();
    set_color(context_, page_color, 0.8);
    cairo_set_line_width(context_, 7 * unit_);
    cairo_stroke_preserve(context_);
    set_color(context_, path_color);
    cairo_set_line_width(context_, 3.5 * unit_);
    cairo_stroke(context_);
    cairo_restore(context_);
  }

  void draw_marks() {
    begin();
    draw_arrows();
    draw_ends();
    cairo_restore(context_);
  }

 private:
  static bool is_known(const MapPosition& position) noexcept {
    return std::isfinite(position.x) && std::isfinite(position.y);
  }

  void begin() noexcept {
    cairo_save(context_);
    add_rectangle(context_, view_.panel());
    cairo_clip(context_);
    cairo_set_line_join(context_, CAIRO_LINE_JOIN_ROUND);
    cairo_set_line_cap(context_, CAIRO_LINE_CAP_ROUND);
  }

  void trace() noexcept {
    bool is_open = false;
    for (const MapPosition& position : path_) {
      if (!is_known(position)) {
        is_open = false;
        continue;
      }
      const double x = view_.column(position.x);
      const double y = view_.row(position.y);
      if (is_open) {
        cairo_line_to(context_, x, y);
      } else {
        cairo_move_to(context_, x, y);
      }
      is_open = true;
    }
  }

  /// Arrowheads show the direction, which matters if the path crosses itself.
  void draw_arrows() noexcept {
    const double apart = 260 * unit_;
    double since_last = apart / 2;
    set_color(context_, path_color);
    for (std::size_t i = 1; i < path_.size(); ++i) {
      if (!is_known(path_[i - 1]) || !is_known(path_[i])) continue;
      const double x = view_.column(path_[i].x);
      const double y = view_.row(path_[i].y);
      const double along_x = x - view_.column(path_[i - 1].x);
      const double along_y = y - view_.row(path_[i - 1].y);
      const double length = std::hypot(along_x, along_y);
      since_last += length;
      if (since_last < apart || length == 0) continue;
      since_last = 0;
      draw_head(x, y, along_x / length, along_y / length);
    }
  }

  void draw_head(double x, double y, double along_x, double along_y) noexcept {
    const double length = 11 * unit_;
    const double half = 9 * unit_;
    cairo_move_to(context_, x + along_x * length, y + along_y * length);
    cairo_line_to(context_, x - along_x * length - along_y * half,
                  y - along_y * length + along_x * half);
    cairo_line_to(context_, x - along_x * length + along_y * half,
                  y - along_y * length - along_x * half);
    cairo_close_path(context_);
    cairo_fill(context_);
  }

  void draw_ends() {
    const auto first = std::ranges::find_if(path_, is_known);
    if (first == path_.end()) return;
    const auto last = std::ranges::find_if(path_.rbegin(), path_.rend(), is_known);
    const double start_x = view_.column(first->x);
    const double end_x = view_.column(last->x);
    const double start_y = view_.row(first->y);
    const double end_y = view_.row(last->y);
    const bool ends_right = end_x >= start_x;
    if (std::hypot(end_x - start_x, end_y - start_y) < 40 * unit_) {  // names would overlap
      draw_mark(context_, start_x, start_y, start_color, "start and end", side(start_x, false),
                unit_);
      return;
    }
    draw_mark(context_, end_x, end_y, end_color, "end", side(end_x, ends_right), unit_);
    draw_mark(context_, start_x, start_y, start_color, "start", side(start_x, !ends_right), unit_);
  }

  /// Left-aligned text is to the right of a mark. Near an edge, it is on the inner side.
  [[nodiscard]] Align side(double x, bool is_right) const noexcept {
    const double space = 200 * unit_;
    if (x + space > view_.panel().right()) return Align::right;
    if (x - space < view_.panel().x) return Align::left;
    return is_right ? Align::left : Align::right;
  }

  cairo_t* context_;
  const MapView& view_;
  std::span<const MapPosition> path_;
  double unit_;
};

/// Multiples of `step` from `low` to `high`, with their text.
struct Tick {
  double value;
  std::string text;
};
std::vector<Tick> ticks(double low, double high, double step) {
  std::vector<Tick> all;
  for (double number = std::ceil(low / step); number * step <= high; ++number) {
    const double value = number * step + 0.0;  // not -0
    std::string text = fmt::format("{:.{}f}", std::abs(value), step < 1 ? 1 : 0);
    all.push_back({value, value < 0 ? "\u2212" + text : text});
  }
  return all;
}

/// The smallest round distance between ticks along x that keeps their numbers apart, metres.
double tick_step(cairo_t* context, const MapView& view, const Font& font, double unit) {
  const Rectangle& panel = view.panel();
  double step = ring_step(300 * unit / view.pixels_per_metre());
  for (const double factor : {1.0, 2.0, 2.5, 2.0, 2.0, 2.5}) {
    step *= factor;
    double widest = 0;
    for (const Tick& tick : ticks(view.x(panel.x), view.x(panel.right()), step)) {
      widest = std::max(widest, text_width(context, tick.text, font));
    }
    if (widest + 30 * unit < step * view.pixels_per_metre()) break;
  }
  return step;
}

void draw_coordinates(const Canvas& canvas, const MapView& view, double unit) {
  cairo_t* context = canvas.context();
  const Rectangle& panel = view.panel();
  const Font font{.size = 22 * unit, .bold = false, .color = muted_text_color};
  const Font name_font{.size = 22 * unit, .bold = true, .color = text_color};
  const double step = tick_step(context, view, font, unit);
  const double length = 8 * unit;
  const double gap = 12 * unit;
  const double name_left = panel.right() - text_width(context, "x in m", name_font) - gap;
  cairo_set_line_width(context, 1.5 * unit);
  for (const auto& [x, text] : ticks(view.x(panel.x), view.x(panel.right()), step)) {
    cairo_move_to(context, view.column(x), panel.bottom());
    cairo_line_to(context, view.column(x), panel.bottom() + length);
    set_color(context, muted_text_color);
    cairo_stroke(context);
    if (view.column(x) + text_width(context, text, font) / 2 > name_left) continue;
    draw_text(context, view.column(x), panel.bottom() + 34 * unit, text, font, Align::center);
  }
  const double y_step = ring_step(300 * unit / view.pixels_per_metre());
  for (const auto& [y, text] : ticks(view.y(panel.bottom()), view.y(panel.y), y_step)) {
    cairo_move_to(context, panel.x, view.row(y));
    cairo_line_to(context, panel.x - length, view.row(y));
    set_color(context, muted_text_color);
    cairo_stroke(context);
    if (view.row(y) < panel.y + 46 * unit) continue;
    draw_text(context, panel.x - length - gap / 2, view.row(y) + 8 * unit, text,
              shrunk(context, text, font, panel.x - length - gap), Align::right);
  }
  draw_text(context, panel.right(), panel.bottom() + 34 * unit, "x in m", name_font, Align::right);
  draw_text(context, panel.x - length - gap / 2, panel.y + 18 * unit, "y in m", name_font,
            Align::right);
}

/// Draws the scale bar into the right end of the heading, next to the title. Returns the
/// heading without it.
Rectangle draw_map_scale(const Canvas& canvas, const MapView& view, const Rectangle& heading,
                         double unit) {
  const double step = ring_step(660 * unit / view.pixels_per_metre());
  const double length = step * view.pixels_per_metre();
  const double left = heading.right() - length;
  draw_bar(canvas.context(), left, heading.y + 62 * unit, length, fmt::format("{:g} m", step), unit,
           text_color);
  return {heading.x, heading.y, heading.width - length - 40 * unit, heading.height};
}

Status refuse_map(std::string message) {
  return Status(StatusCode::invalid_argument, "map image: " + std::move(message));
}

Status check(const GroundGrid& grid, const GroundMapPicture& options) {
  constexpr int smallest = 640;
  constexpr int largest = 8192;
  if (options.max_size < smallest || options.max_size > largest) {
    return refuse_map(
        fmt::format("size of {} pixels (expected {} to {})", options.max_size, smallest, largest));
  }
  if (grid.heights.empty() || grid.columns == 0 || grid.heights.size() % grid.columns != 0) {
    return refuse_map(fmt::format("{} heights in rows of {} (expected one or more whole rows)",
                                  grid.heights.size(), grid.columns));
  }
  if (!(grid.cell > 0) || !std::isfinite(grid.cell + grid.min_x + grid.min_y)) {
    return refuse_map(
        fmt::format("cells of {} m from ({}, {}) (expected a positive size and a finite position)",
                    grid.cell, grid.min_x, grid.min_y));
  }
  return {};
}

std::vector<std::byte> picture(const GroundGrid& grid, const GroundMapPicture& options) {
  const Ground ground(grid);
  const Bounds bounds = shown_bounds(ground, options.path);
  const MapLayout layout = suitable_layout(bounds, grid.cell, options.max_size);
  const Canvas canvas(layout.width, layout.height);
  const MapView view(layout.panel, bounds);
  const ReliefLook look = ground.look();

  fill(canvas, {0, 0, static_cast<double>(layout.width), static_cast<double>(layout.height)},
       page_color);
  draw_relief(canvas, view, ground, look);
  PathDrawing path(canvas, view, options.path, layout.unit);
  path.draw_line();
  draw_contour_lines(canvas, view, ground, look, layout.unit);
  path.draw_marks();
  add_rectangle(canvas.context(), layout.panel);
  cairo_set_line_width(canvas.context(), 1.5 * layout.unit);
  set_color(canvas.context(), muted_text_color);
  cairo_stroke(canvas.context());
  draw_coordinates(canvas, view, layout.unit);
  const Rectangle heading = draw_map_scale(canvas, view, layout.heading, layout.unit);
  draw_heading(canvas, heading, layout.unit, options.title, options.subtitle);
  draw_relief_legend(canvas, layout.legend, look, "blank: unknown, blue: path of the sensor",
                     layout.unit);
  return canvas.png();
}

}  // namespace

Status draw_ground_map(const std::filesystem::path& png, const GroundGrid& grid,
                       const GroundMapPicture& options) noexcept try {
  if (Status status = check(grid, options); !status.ok()) return status;
  return io::write_file(png, picture(grid, options));
} catch (const std::bad_alloc&) {
  return Status(StatusCode::out_of_memory);
}

}  // namespace flagstone::render
