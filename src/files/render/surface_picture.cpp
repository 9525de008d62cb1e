// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "files/render/surface_picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <new>
#include <utility>
#include <vector>

#include "files/io/atomic_file.hpp"
#include "files/render/canvas.hpp"
#include "files/render/contour_layer.hpp"
#include "files/render/heading.hpp"
#include "files/render/height_map.hpp"
#include "files/render/layout.hpp"
#include "files/render/relief.hpp"
#include "files/render/scale_layer.hpp"
#include "files/render/surface_legend.hpp"
#include "files/render/top_view.hpp"

namespace flagstone::render {
namespace {

Status refuse(std::string message) {
  return Status(StatusCode::invalid_argument, "surface picture: " + std::move(message));
}

Status check(const GroundSurface& surface, const SurfacePicture& options) {
  constexpr int smallest = 320;
  constexpr int largest = 8192;
  if (surface.empty()) return refuse("there is no surface; its method makes none");
  for (const int size : {options.width, options.height}) {
    if (size < smallest || size > largest) {
      return refuse(fmt::format("size {} x {} pixels; each may be {} to {}", options.width,
                                options.height, smallest, largest));
    }
  }
  const bool asks_for_a_range = options.range >= 1 && options.range <= 1000;
  if (!asks_for_a_range && options.range != 0) {
    return refuse(
        fmt::format("range {} m; it may be 1 to 1000, or 0 for a suitable one", options.range));
  }
  return {};
}

/// Known ground, sampled evenly; each sample weighs as much as the surface is sure of it.
struct Sample {
  double distance;   // from the sensor, the larger of |x| and |y|, metres
  double height;     // metres
  double steepness;  // metres a metre
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
      constexpr double least = 1e-3;  // so that ground nobody is sure of has a weight, too
      samples.push_back({std::max(std::abs(x), std::abs(y)), ground.height, std::tan(ground.slope),
                         least + ground.confidence});
    }
  }
  return samples;
}

/// The least value that `share` of the weight lies at or below; `none` without samples.
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

struct Look {
  ReliefLook relief;
  ContourStep step;
};

/// Colours from the first to the last contour line around nearly all of the heights, and shading
/// that shows gentle slopes.
Look suitable_look(const GroundSurface& surface, double range) {
  std::vector<Sample> samples = samples_of(surface, range);
  const double lowest = quantile(samples, &Sample::height, 0.02, -1);
  const double highest = quantile(samples, &Sample::height, 0.98, 1);
  const ContourStep step = suitable_step(highest - lowest);
  const double middle = (lowest + highest) / 2;
  constexpr double least_span = 1;  // metres; colours do not make mountains of a level road
  const double half = std::max(highest - lowest, least_span) / 2;
  const HeightRange heights{step.height * std::floor((middle - half) / step.height),
                            step.height * std::ceil((middle + half) / step.height)};
  constexpr double well_shaded = 0.3;  // metres a metre
  constexpr double most_exaggeration = 5;
  const double steep = quantile(samples, &Sample::steepness, 0.85, 0);
  const double exaggeration =
      std::clamp(std::round(well_shaded / std::max(steep, 1e-3)), 1.0, most_exaggeration);
  return {{.heights = heights, .exaggeration = exaggeration}, step};
}

std::vector<std::byte> picture(const GroundSurface& surface, const SurfacePicture& options) {
  const Canvas canvas(options.width, options.height);
  const Layout layout = arrange(options.width, options.height, 1);
  const double range = options.range != 0 ? double{options.range} : suitable_range(surface);
  const TopView view(layout.panel, range);
  const Look look = suitable_look(surface, range);

  fill(canvas, {0, 0, static_cast<double>(options.width), static_cast<double>(options.height)},
       page_color);
  // The panel is seldom a square: what is drawn reaches to its longer sides.
  const double reach =
      std::min<double>(surface.extent(), std::max(layout.panel.width, layout.panel.height) /
                                             (2 * view.pixels_per_metre()));
  draw_relief(canvas, view, surface, reach, look.relief);
  constexpr double samples_apart = 4;  // pixels
  const HeightMap map = smoothed_map_of(surface, reach, samples_apart / view.pixels_per_metre());
  const double span = look.relief.heights.span();  // bounds the number of lines
  draw_contours(canvas, view, map,
                {look.relief.heights.lowest - span, look.relief.heights.highest + span}, look.step,
                layout.unit);
  draw_scale(canvas, view, range, {}, layout.unit, map_ink);
  add_rectangle(canvas.context(), layout.panel);
  cairo_set_line_width(canvas.context(), 1.5 * layout.unit);
  set_color(canvas.context(), muted_text_color);
  cairo_stroke(canvas.context());
  draw_heading(canvas, layout.heading, layout.unit, options.title, options.subtitle);
  draw_surface_legend(canvas, layout.legend, look.relief, look.step, layout.unit);
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
