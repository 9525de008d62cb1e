// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "files/render/point_layer.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace flagstone::render {
namespace {

// The pixels points may change: columns and rows from `left` and `top` to before `right`, `bottom`.
struct Window {
  int left, top, right, bottom;
};

Window window_of(const Rectangle& panel) noexcept {
  return {.left = static_cast<int>(std::ceil(panel.x)),
          .top = static_cast<int>(std::ceil(panel.y)),
          .right = static_cast<int>(std::floor(panel.right())),
          .bottom = static_cast<int>(std::floor(panel.bottom()))};
}

// Half-way values round up: all that matters is that it is the same everywhere.
std::uint32_t mixed(std::uint32_t below, std::uint32_t above, std::uint32_t opacity) noexcept {
  return (below * (255 - opacity) + above * opacity + 127) / 255;
}

std::uint32_t mixed(std::uint32_t pixel, Color color, std::uint32_t opacity) noexcept {
  const std::uint32_t red = mixed((pixel >> 16) & 0xFF, color.red, opacity);
  const std::uint32_t green = mixed((pixel >> 8) & 0xFF, color.green, opacity);
  const std::uint32_t blue = mixed(pixel & 0xFF, color.blue, opacity);
  return red << 16 | green << 8 | blue;
}

// Few points are drawn larger, or they could not be seen. In pixels of the default picture.
double point_radius(std::size_t count) noexcept {
  constexpr double dense_scan = 120'000;
  const double sparseness = dense_scan / static_cast<double>(std::max<std::size_t>(count, 1));
  return std::clamp(0.9 * std::pow(sparseness, 0.25), 0.7, 5.0);
}

class DiscPainter {
 public:
  DiscPainter(Canvas::Pixels pixels, const Window& window) noexcept
      : pixels_(pixels), window_(window) {}

  // A disc with soft edges: a pixel's cover falls from 1 to 0 over the pixel that the edge crosses.
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

// False for what is not finite, too. Asked before any conversion to a whole number of pixels.
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

}  // namespace flagstone::render
