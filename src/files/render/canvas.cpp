// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "files/render/canvas.hpp"

#include <new>
#include <numbers>

#include "files/render/rendering_available.hpp"

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
  // Cairo keeps the first error of a context; all that can have happened here is lack of memory.
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

}  // namespace flagstone::render
