// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "files/render/surface_picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <new>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "files/io/atomic_file.hpp"
#include "files/render/canvas.hpp"
#include "files/render/contours.hpp"
#include "files/render/height_map.hpp"
#include "files/render/relief.hpp"
#include "files/render/scale.hpp"
#include "files/render/text.hpp"
#include "flagstone/ground_surface.hpp"

namespace flagstone::render {

namespace {

std::uint32_t pixel_of(const GroundSurface& surface, float x, float y, const ReliefLook& look) {
  const GroundSample ground = surface.at(x, y);
  if (std::isnan(ground.height)) return 0;
  // Heights one cell of the surface away on both sides, so that slopes change smoothly for cells of
  // any size.
  const float cell = surface.resolution(x, y);
  const double rise_x =
      slope(surface.height(x - cell, y), ground.height, surface.height(x + cell, y), cell);
  const double rise_y =
      slope(surface.height(x, y - cell), ground.height, surface.height(x, y + cell), cell);
  constexpr double faintest = 0.25;
  const double confidence = std::clamp(double{ground.confidence}, 0.0, 1.0);
  return relief_pixel(ground.height, rise_x, rise_y, look,
                      std::lerp(faintest, 1.0, std::sqrt(confidence)));
}

/// Draws the ground within `range` metres of the sensor, paler at low confidence, and blank where
/// the ground is unknown.
void draw_relief(const Canvas& canvas, const TopView& view, const GroundSurface& surface,
                 double range, const ReliefLook& look) {
  // Computes every second pixel along both axes; Cairo interpolates between them.
  const double step = 2 / view.pixels_per_metre();
  const auto width = static_cast<std::size_t>(std::ceil(2 * range / step));
  std::vector<std::uint32_t> pixels(width * width);
  for (std::size_t row = 0; row < width; ++row) {  // from the farthest ahead
    const auto x = static_cast<float>(range - (static_cast<double>(row) + 0.5) * step);
    for (std::size_t column = 0; column < width; ++column) {  // from the left
      const auto y = static_cast<float>(range - (static_cast<double>(column) + 0.5) * step);
      pixels[row * width + column] = pixel_of(surface, x, y, look);
    }
  }
  paint_relief(canvas, view.panel(), {.pixels = pixels, .width = width},
               {.x = view.column(range), .y = view.row(range), .pixels_per_sample = 2});
}

/// The samples of a square map in an image.
ContourGrid contour_grid(const HeightMap& map, const TopView& view) {
  ContourGrid grid{.heights = map.heights, .width = map.width, .to_pixels = {}};
  const double step = map.cell * view.pixels_per_metre();
  cairo_matrix_init(&grid.to_pixels, 0, -step, step, 0, view.column(map.y(0)), view.row(map.x(0)));
  return grid;
}

Status refuse_surface(std::string message) {
  return Status(StatusCode::invalid_argument, "surface image: " + std::move(message));
}

Status check(const GroundSurface& surface, const SurfacePicture& options) {
  constexpr int smallest = 320;
  constexpr int largest = 8192;
  if (surface.empty())
    return refuse_surface("there is no surface (the method does not provide one)");
  for (const int size : {options.width, options.height}) {
    if (size < smallest || size > largest) {
      return refuse_surface(fmt::format("size {} x {} pixels (expected {} to {} each)",
                                        options.width, options.height, smallest, largest));
    }
  }
  const bool asks_for_a_range = options.range >= 1 && options.range <= 1000;
  if (!asks_for_a_range && options.range != 0) {
    return refuse_surface(fmt::format(
        "range {} m (expected 1 to 1000, or 0 to choose a suitable one)", options.range));
  }
  return {};
}

/// An evenly spaced sample of known ground, weighted by its confidence.
struct Sample {
  double distance;   // from the sensor, the larger of |x| and |y|, metres
  double height;     // metres
  double steepness;  // m/m
  double weight;
};

std::vector<Sample> samples_of(const GroundSurface& surface, double range) {
  constexpr int per_side = 200;
  std::vector<Sample> samples;
  for (int row = 0; row < per_side; ++row) {
    for (int column = 0; column < per_side; ++column) {
      const double x = range * ((2 * column + 1.0) / per_side - 1);
      const double y = range * ((2 * row + 1.0) / per_side - 1);
      const GroundSample ground = surface.at(static_cast<float>(x), static_cast<float>(y));
      if (!std::isfinite(ground.height) || !std::isfinite(ground.slope)) continue;
      constexpr double least = 1e-3;  // ground without any confidence has a weight too
      samples.push_back({std::max(std::abs(x), std::abs(y)), ground.height, std::tan(ground.slope),
                         least + ground.confidence});
    }
  }
  return samples;
}

/// The weighted quantile: the smallest value with at least `share` of the weight at or below it.
/// `none` if there are no samples.
double quantile(std::vector<Sample>& samples, double Sample::* value, double share, double none) {
  if (samples.empty()) return none;
  std::ranges::sort(samples, {}, value);
  double total = 0;
  for (const Sample& sample : samples) total += sample.weight;
  double sum = 0;
  for (const Sample& sample : samples) {
    sum += sample.weight;
    if (sum >= share * total) return sample.*value;
  }
  return samples.back().*value;
}

double suitable_range(const GroundSurface& surface) {
  const double extent = surface.extent();
  std::vector<Sample> samples = samples_of(surface, extent);
  const double range = quantile(samples, &Sample::distance, 0.98, extent);
  return std::clamp(10 * std::ceil(range / 10), 1.0, std::max(1.0, extent));
}

ReliefLook look_of(const GroundSurface& surface, double range) {
  std::vector<Sample> samples = samples_of(surface, range);
  const double lowest = quantile(samples, &Sample::height, 0.02, -1);
  const double highest = quantile(samples, &Sample::height, 0.98, 1);
  return suitable_look({lowest, highest}, quantile(samples, &Sample::steepness, 0.85, 0));
}

std::vector<std::byte> picture(const GroundSurface& surface, const SurfacePicture& options) {
  const Canvas canvas(options.width, options.height);
  const Layout layout = arrange(options.width, options.height, 1);
  const double range = options.range != 0 ? double{options.range} : suitable_range(surface);
  const TopView view(layout.panel, range);
  const ReliefLook look = look_of(surface, range);

  fill(canvas, {0, 0, static_cast<double>(options.width), static_cast<double>(options.height)},
       page_color);
  // The panel is usually not square: draw up to its longer sides.
  const double reach =
      std::min<double>(surface.extent(), std::max(layout.panel.width, layout.panel.height) /
                                             (2 * view.pixels_per_metre()));
  draw_relief(canvas, view, surface, reach, look);
  constexpr double samples_apart = 4;  // pixels
  const HeightMap map = smoothed_map_of(surface, reach, samples_apart / view.pixels_per_metre());
  const double span = look.heights.span();  // bounds the number of lines
  draw_contours(canvas, view.panel(), contour_grid(map, view),
                {look.heights.lowest - span, look.heights.highest + span}, look.step, layout.unit);
  draw_scale(canvas, view, range, {}, layout.unit, map_ink);
  add_rectangle(canvas.context(), layout.panel);
  cairo_set_line_width(canvas.context(), 1.5 * layout.unit);
  set_color(canvas.context(), muted_text_color);
  cairo_stroke(canvas.context());
  draw_heading(canvas, layout.heading, layout.unit, options.title, options.subtitle);
  draw_relief_legend(canvas, layout.legend, look, "pale: low confidence, blank: unknown",
                     layout.unit);
  return canvas.png();
}

}  // namespace

Status draw_surface(const std::filesystem::path& png, const GroundSurface& surface,
                    const SurfacePicture& options) noexcept try {
  if (Status status = check(surface, options); !status.ok()) return status;
  return io::write_file(png, picture(surface, options));
} catch (const std::bad_alloc&) {
  return Status(StatusCode::out_of_memory);
}

}  // namespace flagstone::render
