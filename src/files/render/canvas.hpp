// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cairo.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "files/render/palette.hpp"
#include "flagstone/status.hpp"

namespace flagstone::render {

/// A rectangle of the picture, pixels; x to the right, y down, (x, y) its upper left corner.
struct Rectangle {
  constexpr Rectangle(double left, double top, double width_of, double height_of) noexcept
      : x(left), y(top), width(width_of), height(height_of) {}

  double x, y, width, height;

  [[nodiscard]] double right() const noexcept { return x + width; }
  [[nodiscard]] double bottom() const noexcept { return y + height; }
  [[nodiscard]] double center_x() const noexcept { return x + width / 2; }
  [[nodiscard]] double center_y() const noexcept { return y + height / 2; }
};

/// An opaque picture in memory that Cairo draws into.
class Canvas {
 public:
  /// Throws std::bad_alloc. Both sizes 1 to 32,767 pixels.
  Canvas(int width, int height);

  /// Cairo's drawing context, for shapes and text.
  [[nodiscard]] cairo_t* context() const noexcept { return context_.get(); }

  /// Pixels in memory, 0x00RRGGBB, row by row, for drawing without Cairo. Calls between the two
  /// must be enclosed in begin_pixels() and end_pixels().
  struct Pixels {
    std::span<std::uint32_t> data;
    std::size_t row_length;  ///< pixels from one row to the next, at least the width
  };
  [[nodiscard]] Pixels begin_pixels() const noexcept;
  void end_pixels() const noexcept;

  /// The picture as a PNG file's bytes. Throws std::bad_alloc.
  [[nodiscard]] std::vector<std::byte> png() const;

 private:
  struct Release {
    void operator()(cairo_surface_t* surface) const noexcept { cairo_surface_destroy(surface); }
    void operator()(cairo_t* context) const noexcept { cairo_destroy(context); }
  };
  std::unique_ptr<cairo_surface_t, Release> surface_;
  std::unique_ptr<cairo_t, Release> context_;
};

/// Sets the colour for what is drawn next; `opacity` 0 to 1.
void set_color(cairo_t* context, Color color, double opacity = 1) noexcept;

/// Appends a rectangle, its corners rounded by `radius` pixels, to the path.
void add_rectangle(cairo_t* context, const Rectangle& rectangle, double radius = 0) noexcept;

/// Fills a rectangle with a colour.
void fill(const Canvas& canvas, const Rectangle& rectangle, Color color) noexcept;

}  // namespace flagstone::render
