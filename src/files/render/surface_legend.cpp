// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "files/render/surface_legend.hpp"

#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <string>
#include <utility>

#include "files/render/palette.hpp"
#include "files/render/text.hpp"

namespace flagstone::render {
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

/// Heights below the bar: multiples of a round step, a few.
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

void draw_surface_legend(const Canvas& canvas, const Rectangle& legend, const ReliefLook& look,
                         const ContourStep& step, double unit) {
  cairo_t* context = canvas.context();
  const Font name_font{.size = 24 * unit, .bold = false, .color = text_color};
  const Font bold_font{.size = 24 * unit, .bold = true, .color = text_color};
  const Font number_font{.size = 22 * unit, .bold = false, .color = muted_text_color};
  const double name_line = legend.y + 26 * unit;
  const double number_line = legend.y + 56 * unit;

  draw_text(context, legend.x, name_line, "Height", bold_font);
  draw_text(context, legend.x, number_line, "z, metres", number_font);
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
  const std::string shading =
      look.exaggeration > 1 ? fmt::format("shaded as if {:g} times as steep", look.exaggeration)
                            : std::string("shaded as steep as it is");
  for (const auto& [text, line] :
       {std::pair{std::string("pale: less sure, blank: not known"), name_line},
        std::pair{shading, number_line}}) {
    draw_text(context, x, line, text, shrunk(context, text, name_font, legend.right() - x));
  }
}

}  // namespace flagstone::render
