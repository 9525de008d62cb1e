// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "files/render/relief.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <new>
#include <numbers>

namespace flagstone::render {
namespace {

struct Tone {
  double red, green, blue;  // 0 to 1
};

Tone mixed(const Tone& a, const Tone& b, double share_of_b) noexcept {
  return {std::lerp(a.red, b.red, share_of_b), std::lerp(a.green, b.green, share_of_b),
          std::lerp(a.blue, b.blue, share_of_b)};
}

// Greens, yellows and browns of atlases, all of them light, so that shade and lines stand out.
constexpr std::array<Tone, 6> tones = {{{0.53, 0.70, 0.61},
                                        {0.69, 0.81, 0.64},
                                        {0.89, 0.89, 0.68},
                                        {0.93, 0.82, 0.60},
                                        {0.83, 0.66, 0.49},
                                        {0.73, 0.55, 0.46}}};
constexpr Tone shadow = {0.16, 0.17, 0.30};  // bluish, as under an open sky
constexpr Tone sunlight = {1, 0.99, 0.93};

Tone tone_of(double share) noexcept {
  const double place = std::clamp(share, 0.0, 1.0) * (tones.size() - 1);
  const auto first = std::min(static_cast<std::size_t>(place), tones.size() - 2);
  return mixed(tones[first], tones[first + 1], place - static_cast<double>(first));
}

/// How bright ground of these slopes, metres a metre along x and y, is; 1: as bright as level
/// ground. The light stands 45 degrees high over the upper left, where both x and y grow.
double brightness(double along_x, double along_y) noexcept {
  return (1 - (along_x + along_y) / std::numbers::sqrt2) / std::hypot(along_x, along_y, 1.0);
}

Tone shaded(const Tone& tone, double bright) noexcept {
  constexpr double darkest = 0.72;   // share of shadow in what no light falls on
  constexpr double brightest = 1.5;  // share of sunlight a unit above level ground
  return bright < 1 ? mixed(tone, shadow, darkest * (1 - std::max(bright, 0.0)))
                    : mixed(tone, sunlight, std::min(1.0, brightest * (bright - 1)));
}

/// Slope at a place from heights a cell of the surface to either side of it, so that it changes
/// smoothly over cells of any size. To one side alone at the rim of what is known.
double slope(float before, float here, float after, float cell) noexcept {
  if (std::isnan(before) && std::isnan(after)) return 0;
  if (std::isnan(before)) return (after - here) / cell;
  if (std::isnan(after)) return (here - before) / cell;
  return (after - before) / (2 * cell);
}

std::uint32_t pixel(const Tone& tone, double opacity) noexcept {
  const auto part = [opacity](double value) noexcept {  // Cairo wants colour times opacity
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

}  // namespace

Color height_color(double share) noexcept {
  const Tone tone = tone_of(share);
  const auto part = [](double value) {
    return static_cast<std::uint8_t>(std::lround(255 * value));
  };
  return {part(tone.red), part(tone.green), part(tone.blue)};
}

void draw_relief(const Canvas& canvas, const TopView& view, const GroundSurface& surface,
                 double range, const ReliefLook& look) {
  // Every second pixel along both axes; Cairo fills in between.
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

}  // namespace flagstone::render
