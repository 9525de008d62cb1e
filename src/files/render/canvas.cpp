// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "files/render/canvas.hpp"

#include <algorithm>
#include <cmath>
#include <new>
#include <numbers>
#include <utility>

#include "files/render/birds_eye.hpp"
#include "files/render/rendering_available.hpp"
#include "files/render/side_by_side.hpp"

namespace flagstone::render {
namespace {

cairo_status_t append(void* bytes, const unsigned char* data, unsigned int length) noexcept {
  auto& file = *static_cast<std::vector<std::byte>*>(bytes);
  const auto* begin = reinterpret_cast<const std::byte*>(data);
  try {
    file.insert(file.end(), begin, begin + length);
  } catch (const std::bad_alloc&) {
    return CAIRO_STATUS_NO_MEMORY;  // no exception may cross Cairo's and libpng's C frames
  }
  return CAIRO_STATUS_SUCCESS;
}

}  // namespace

Status rendering_available() { return {}; }

Canvas::Canvas(int width, int height)
    : surface_(cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, height)),
      context_(cairo_create(surface_.get())) {
  if (cairo_status(context_.get()) != CAIRO_STATUS_SUCCESS) throw std::bad_alloc();
}

Canvas::Pixels Canvas::begin_pixels() const noexcept {
  cairo_surface_flush(surface_.get());
  const auto rows = static_cast<std::size_t>(cairo_image_surface_get_height(surface_.get()));
  const auto row_length = static_cast<std::size_t>(cairo_image_surface_get_stride(surface_.get())) /
                          sizeof(std::uint32_t);
  auto* data = reinterpret_cast<std::uint32_t*>(cairo_image_surface_get_data(surface_.get()));
  return {.data = {data, rows * row_length}, .row_length = row_length};
}

void Canvas::end_pixels() const noexcept { cairo_surface_mark_dirty(surface_.get()); }

std::vector<std::byte> Canvas::png() const {
  std::vector<std::byte> file;
  // Cairo keeps the first error of a context, which here can only be a lack of memory.
  if (cairo_status(context_.get()) != CAIRO_STATUS_SUCCESS ||
      cairo_surface_write_to_png_stream(surface_.get(), append, &file) != CAIRO_STATUS_SUCCESS)
    throw std::bad_alloc();
  return file;
}

void set_color(cairo_t* context, Color color, double opacity) noexcept {
  cairo_set_source_rgba(context, color.red / 255.0, color.green / 255.0, color.blue / 255.0,
                        opacity);
}

void add_rectangle(cairo_t* context, const Rectangle& rectangle, double radius) noexcept {
  constexpr double quarter = std::numbers::pi / 2;
  cairo_new_sub_path(context);
  cairo_arc(context, rectangle.right() - radius, rectangle.y + radius, radius, -quarter, 0);
  cairo_arc(context, rectangle.right() - radius, rectangle.bottom() - radius, radius, 0, quarter);
  cairo_arc(context, rectangle.x + radius, rectangle.bottom() - radius, radius, quarter,
            2 * quarter);
  cairo_arc(context, rectangle.x + radius, rectangle.y + radius, radius, 2 * quarter, 3 * quarter);
  cairo_close_path(context);
}

void fill(const Canvas& canvas, const Rectangle& rectangle, Color color) noexcept {
  add_rectangle(canvas.context(), rectangle);
  set_color(canvas.context(), color);
  cairo_fill(canvas.context());
}

Layout arrange(int width, int height, int legend_rows) noexcept {
  static const BirdsEye defaults;
  const double unit = std::min(static_cast<double>(width) / defaults.width,
                               static_cast<double>(height) / defaults.height);
  const double margin = std::round(40 * unit);
  const double heading_height = std::round(92 * unit);
  const double legend_height = std::round((legend_rows * legend_row_height - 14) * unit);
  const double gap = std::round(22 * unit);
  const double inner_width = width - 2 * margin;
  const double panel_top = margin + heading_height;
  const double panel_bottom = height - margin - legend_height - gap;
  return {.unit = unit,
          .heading = {margin, margin, inner_width, heading_height},
          .panel = {margin, panel_top, inner_width, panel_bottom - panel_top},
          .legend = {margin, panel_bottom + gap, inner_width, legend_height}};
}

PanelGrid arrange_panels(int width, std::size_t panels) {
  static const SideBySide defaults;
  // Four look better as two rows of two.
  const std::size_t columns = panels == 4 ? 2 : std::clamp<std::size_t>(panels, 1, 3);
  const std::size_t rows = (panels + columns - 1) / columns;
  const double unit = static_cast<double>(width) / defaults.width;
  const double margin = std::round(40 * unit);
  const double gap = std::round(24 * unit);
  const double heading_height = std::round(92 * unit);
  const double legend_height = std::round(64 * unit);
  const double inner_width = width - 2 * margin;
  const double side = std::floor((inner_width + gap) / static_cast<double>(columns) - gap);
  const double row_height = side + std::round(caption_height * unit);
  const double legend_top = margin + heading_height + static_cast<double>(rows) * row_height + gap;

  PanelGrid grid{.unit = unit,
                 .height = static_cast<int>(legend_top + legend_height + margin),
                 .heading = {margin, margin, inner_width, heading_height},
                 .panels = {},
                 .legend = {margin, legend_top, inner_width, legend_height}};
  for (std::size_t panel = 0; panel < panels; ++panel) {
    const std::size_t row = panel / columns;
    const std::size_t column = panel % columns;
    grid.panels.emplace_back(margin + static_cast<double>(column) * (side + gap),
                             margin + heading_height + static_cast<double>(row) * row_height, side,
                             side);
  }
  return grid;
}

Status refuse(std::string message) {
  return Status(StatusCode::invalid_argument, "image: " + std::move(message));
}

}  // namespace flagstone::render
