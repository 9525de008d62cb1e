// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "files/render/relief.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <utility>

#include "files/render/text.hpp"

namespace flagstone::render {
namespace {

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

/// Brightness of ground relative to level ground. The light comes from the upper left, 45 degrees
/// above the horizon.
double brightness(double rise_up, double rise_left) noexcept {
  return (1 - (rise_up + rise_left) / std::numbers::sqrt2) / std::hypot(rise_up, rise_left, 1.0);
}

Tone shaded(const Tone& tone, double bright) noexcept {
  constexpr double darkest = 0.72;   // fraction of shadow colour at brightness 0
  constexpr double brightest = 1.5;  // fraction of sunlight colour per unit of brightness above 1
  return bright < 1 ? mixed(tone, shadow, darkest * (1 - std::max(bright, 0.0)))
                    : mixed(tone, sunlight, std::min(1.0, brightest * (bright - 1)));
}

std::uint32_t pixel(const Tone& tone, double opacity) noexcept {
  const auto part = [opacity](double value) noexcept {  // Cairo requires premultiplied colours
    return static_cast<std::uint32_t>(std::lround(255 * value * opacity));
  };
  return static_cast<std::uint32_t>(std::lround(255 * opacity)) << 24U | part(tone.red) << 16U |
         part(tone.green) << 8U | part(tone.blue);
}

Color height_color(double share) noexcept {
  const Tone tone = tone_of(share);
  const auto part = [](double value) {
    return static_cast<std::uint8_t>(std::lround(255 * value));
  };
  return {part(tone.red), part(tone.green), part(tone.blue)};
}

}  // namespace

ReliefLook suitable_look(const HeightRange& heights, double steep) noexcept {
  const ContourStep step = suitable_step(heights.span());
  const double middle = (heights.lowest + heights.highest) / 2;
  constexpr double least_span = 1;  // metres, so that colours do not exaggerate a level road
  const double half = std::max(heights.span(), least_span) / 2;
  constexpr double well_shaded = 0.3;  // m/m
  constexpr double most_exaggeration = 5;
  return {.heights = {step.height * std::floor((middle - half) / step.height),
                      step.height * std::ceil((middle + half) / step.height)},
          .exaggeration =
              std::clamp(std::round(well_shaded / std::max(steep, 1e-3)), 1.0, most_exaggeration),
          .step = step};
}

double slope(double before, double here, double after, double distance) noexcept {
  if (std::isnan(before) && std::isnan(after)) return 0;
  if (std::isnan(before)) return (after - here) / distance;
  if (std::isnan(after)) return (here - before) / distance;
  return (after - before) / (2 * distance);
}

std::uint32_t relief_pixel(double height, double rise_up, double rise_left, const ReliefLook& look,
                           double opacity) noexcept {
  const Tone tone = tone_of((height - look.heights.lowest) / look.heights.span());
  return pixel(shaded(tone, brightness(look.exaggeration * rise_up, look.exaggeration * rise_left)),
               opacity);
}

void paint_relief(const Canvas& canvas, const Rectangle& panel, const ReliefPixels& relief,
                  const ReliefPlacement& placement) noexcept {
  const auto width = static_cast<int>(relief.width);
  const auto height = static_cast<int>(relief.pixels.size() / relief.width);
  const std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)> image(
      cairo_image_surface_create_for_data(reinterpret_cast<unsigned char*>(relief.pixels.data()),
                                          CAIRO_FORMAT_ARGB32, width, height, 4 * width),
      &cairo_surface_destroy);
  cairo_t* context = canvas.context();
  cairo_save(context);
  add_rectangle(context, panel);
  cairo_clip(context);
  cairo_translate(context, placement.x, placement.y);
  cairo_scale(context, placement.pixels_per_sample, placement.pixels_per_sample);
  cairo_set_source_surface(context, image.get(), 0, 0);
  cairo_pattern_set_filter(cairo_get_source(context), CAIRO_FILTER_BILINEAR);
  cairo_paint(context);
  cairo_restore(context);
}

namespace {

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

}  // namespace

void draw_relief_legend(const Canvas& canvas, const Rectangle& legend, const ReliefLook& look,
                        const std::string& note, double unit) {
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
  draw_heights(context, bar, look.heights, look.step, unit);

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
  draw_text(context, x, name_line, fmt::format("every {:g} m", look.step.height), name_font);
  draw_text(context, x, number_line,
            fmt::format("every {:g} m", look.step.per_index * look.step.height), name_font);

  x += 196 * unit;
  const std::string shading = look.exaggeration > 1
                                  ? fmt::format("shading: slopes times {:g}", look.exaggeration)
                                  : std::string("shading: true slopes");
  for (const auto& [text, line] : {std::pair{note, name_line}, std::pair{shading, number_line}}) {
    draw_text(context, x, line, text, shrunk(context, text, name_font, legend.right() - x));
  }
}

}  // namespace flagstone::render
