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
#include "files/render/scale.hpp"
#include "files/render/text.hpp"
#include "flagstone/ground_surface.hpp"

namespace flagstone::render {

/// Colours and shading of the ground.
struct ReliefLook {
  HeightRange heights;      ///< range of the colours; heights outside have the first or last colour
  double exaggeration = 1;  ///< factor by which slopes are multiplied for shading
};

namespace {

/// The colour of a height before shading; `share` is 0 for the lowest height and 1 for the highest.
Color height_color(double share) noexcept;

/// Draws the ground within `range` metres of the sensor: coloured by height, shaded with light from
/// the upper left, paler at low confidence, and blank where the ground is unknown.
void draw_relief(const Canvas& canvas, const TopView& view, const GroundSurface& surface,
                 double range, const ReliefLook& look);

struct Tone {
  double red, green, blue;  // 0 to 1
};

Tone mixed(const Tone& a, const Tone& b, double share_of_b) noexcept {
  return {std::lerp(a.red, b.red, share_of_b), std::lerp(a.green, b.green, share_of_b),
          std::lerp(a.blue, b.blue, share_of_b)};
}

// Greens, yellows and browns as in atlases, all light, so that shading and lines are visible.
constexpr std::array<Tone, 6> tones = {{{0.53, 0.70, 0.61},
                                        {0.69, 0.81, 0.64},
                                        {0.89, 0.89, 0.68},
                                        {0.93, 0.82, 0.60},
                                        {0.83, 0.66, 0.49},
                                        {0.73, 0.55, 0.46}}};
constexpr Tone shadow = {0.16, 0.17, 0.30};  // bluish, as under a clear sky
constexpr Tone sunlight = {1, 0.99, 0.93};

Tone tone_of(double share) noexcept {
  const double place = std::clamp(share, 0.0, 1.0) * (tones.size() - 1);
  const auto first = std::min(static_cast<std::size_t>(place), tones.size() - 2);
  return mixed(tones[first], tones[first + 1], place - static_cast<double>(first));
}

/// Brightness of ground with these slopes along x and y, m/m, relative to level ground. The light
/// comes from the upper left (positive x and y), 45 degrees above the horizon.
double brightness(double along_x, double along_y) noexcept {
  return (1 - (along_x + along_y) / std::numbers::sqrt2) / std::hypot(along_x, along_y, 1.0);
}

Tone shaded(const Tone& tone, double bright) noexcept {
  constexpr double darkest = 0.72;   // fraction of shadow colour at brightness 0
  constexpr double brightest = 1.5;  // fraction of sunlight colour per unit of brightness above 1
  return bright < 1 ? mixed(tone, shadow, darkest * (1 - std::max(bright, 0.0)))
                    : mixed(tone, sunlight, std::min(1.0, brightest * (bright - 1)));
}

/// Slope from the heights one cell of the surface away on both sides, so that it changes smoothly
/// for cells of any size. One-sided at the edge of known ground.
double slope(float before, float here, float after, float cell) noexcept {
  if (std::isnan(before) && std::isnan(after)) return 0;
  if (std::isnan(before)) return (after - here) / cell;
  if (std::isnan(after)) return (here - before) / cell;
  return (after - before) / (2 * cell);
}

std::uint32_t pixel(const Tone& tone, double opacity) noexcept {
  const auto part = [opacity](double value) noexcept {  // Cairo requires premultiplied colours
    return static_cast<std::uint32_t>(std::lround(255 * value * opacity));
  };
  return static_cast<std::uint32_t>(std::lround(255 * opacity)) << 24U | part(tone.red) << 16U |
         part(tone.green) << 8U | part(tone.blue);
}

std::uint32_t relief_pixel(const GroundSurface& surface, float x, float y, const ReliefLook& look) {
  const GroundSample ground = surface.at(x, y);
  if (std::isnan(ground.height)) return 0;
  const float cell = surface.resolution(x, y);
  const double along_x =
      slope(surface.height(x - cell, y), ground.height, surface.height(x + cell, y), cell);
  const double along_y =
      slope(surface.height(x, y - cell), ground.height, surface.height(x, y + cell), cell);
  const Tone tone = tone_of((ground.height - look.heights.lowest) / look.heights.span());
  constexpr double faintest = 0.25;
  const double confidence = std::clamp(double{ground.confidence}, 0.0, 1.0);
  return pixel(shaded(tone, brightness(look.exaggeration * along_x, look.exaggeration * along_y)),
               std::lerp(faintest, 1.0, std::sqrt(confidence)));
}

Color height_color(double share) noexcept {
  const Tone tone = tone_of(share);
  const auto part = [](double value) {
    return static_cast<std::uint8_t>(std::lround(255 * value));
  };
  return {part(tone.red), part(tone.green), part(tone.blue)};
}

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
      pixels[row * width + column] = relief_pixel(surface, x, y, look);
    }
  }
  const std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)> image(
      cairo_image_surface_create_for_data(reinterpret_cast<unsigned char*>(pixels.data()),
                                          CAIRO_FORMAT_ARGB32, static_cast<int>(width),
                                          static_cast<int>(width), static_cast<int>(4 * width)),
      &cairo_surface_destroy);
  cairo_t* context = canvas.context();
  cairo_save(context);
  add_rectangle(context, view.panel());
  cairo_clip(context);
  cairo_translate(context, view.column(range), view.row(range));
  cairo_scale(context, 2, 2);
  cairo_set_source_surface(context, image.get(), 0, 0);
  cairo_pattern_set_filter(cairo_get_source(context), CAIRO_FILTER_BILINEAR);
  cairo_paint(context);
  cairo_restore(context);
}

using Gradient = std::unique_ptr<cairo_pattern_t, decltype(&cairo_pattern_destroy)>;

void draw_colors(cairo_t* context, const Rectangle& bar, double unit) {
  const Gradient gradient(cairo_pattern_create_linear(bar.x, 0, bar.right(), 0),
                          &cairo_pattern_destroy);
  constexpr int stops = 20;
  for (int stop = 0; stop <= stops; ++stop) {
    const double share = static_cast<double>(stop) / stops;
    const Color color = height_color(share);
    cairo_pattern_add_color_stop_rgb(gradient.get(), share, color.red / 255.0, color.green / 255.0,
                                     color.blue / 255.0);
  }
  add_rectangle(context, bar, 4 * unit);
  cairo_set_source(context, gradient.get());
  cairo_fill_preserve(context);
  cairo_set_line_width(context, 1.5 * unit);
  set_color(context, muted_text_color);
  cairo_stroke(context);
}

/// Draws a few round heights below the bar.
void draw_heights(cairo_t* context, const Rectangle& bar, const HeightRange& heights,
                  const ContourStep& step, double unit) {
  const Font font{.size = 22 * unit, .bold = false, .color = muted_text_color};
  constexpr double most = 6;
  double apart = step.height;
  for (const double factor : {1.0, 2.0, 4.0, 8.0, 20.0}) {
    apart = factor * step.height;
    if (heights.span() / apart <= most) break;
  }
  for (auto number = static_cast<long>(std::ceil(heights.lowest / apart - 1e-6));
       static_cast<double>(number) * apart <= heights.highest + 1e-6; ++number) {
    const double height = static_cast<double>(number) * apart;
    const double x = bar.x + bar.width * (height - heights.lowest) / heights.span();
    cairo_move_to(context, x, bar.bottom());
    cairo_line_to(context, x, bar.bottom() + 6 * unit);
    set_color(context, muted_text_color);
    cairo_stroke(context);
    draw_text(context, x, bar.bottom() + 29 * unit, height_text(height, step), font, Align::center);
  }
}

void draw_surface_legend(const Canvas& canvas, const Rectangle& legend, const ReliefLook& look,
                         const ContourStep& step, double unit) {
  cairo_t* context = canvas.context();
  const Font name_font{.size = 24 * unit, .bold = false, .color = text_color};
  const Font bold_font{.size = 24 * unit, .bold = true, .color = text_color};
  const Font number_font{.size = 22 * unit, .bold = false, .color = muted_text_color};
  const double name_line = legend.y + 26 * unit;
  const double number_line = legend.y + 56 * unit;

  draw_text(context, legend.x, name_line, "Height", bold_font);
  draw_text(context, legend.x, number_line, "z in m", number_font);
  const Rectangle bar{legend.x + 150 * unit, legend.y + 6 * unit, legend.width * 0.4, 24 * unit};
  draw_colors(context, bar, unit);
  draw_heights(context, bar, look.heights, step, unit);

  double x = bar.right() + 66 * unit;
  const auto draw_sample = [&](double y, double width) {
    cairo_move_to(context, x, y);
    cairo_line_to(context, x + 34 * unit, y);
    cairo_set_line_width(context, width);
    set_color(context, contour_color, 0.8);
    cairo_stroke(context);
  };
  draw_sample(name_line - 8 * unit, thin_contour * unit);
  draw_sample(number_line - 8 * unit, bold_contour * unit);
  x += 46 * unit;
  draw_text(context, x, name_line, fmt::format("every {:g} m", step.height), name_font);
  draw_text(context, x, number_line, fmt::format("every {:g} m", step.per_index * step.height),
            name_font);

  x += 196 * unit;
  const std::string shading = look.exaggeration > 1
                                  ? fmt::format("shading: slopes times {:g}", look.exaggeration)
                                  : std::string("shading: true slopes");
  for (const auto& [text, line] :
       {std::pair{std::string("pale: low confidence, blank: unknown"), name_line},
        std::pair{shading, number_line}}) {
    draw_text(context, x, line, text, shrunk(context, text, name_font, legend.right() - x));
  }
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

struct Look {
  ReliefLook relief;
  ContourStep step;
};

/// Colours that span nearly all heights, from contour line to contour line, and shading that shows
/// gentle slopes.
Look suitable_look(const GroundSurface& surface, double range) {
  std::vector<Sample> samples = samples_of(surface, range);
  const double lowest = quantile(samples, &Sample::height, 0.02, -1);
  const double highest = quantile(samples, &Sample::height, 0.98, 1);
  const ContourStep step = suitable_step(highest - lowest);
  const double middle = (lowest + highest) / 2;
  constexpr double least_span = 1;  // metres, so that colours do not exaggerate a level road
  const double half = std::max(highest - lowest, least_span) / 2;
  const HeightRange heights{step.height * std::floor((middle - half) / step.height),
                            step.height * std::ceil((middle + half) / step.height)};
  constexpr double well_shaded = 0.3;  // m/m
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
  // The panel is usually not square: draw up to its longer sides.
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
