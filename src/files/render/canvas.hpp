// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cairo.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "flagstone/status.hpp"

namespace flagstone::render {

/// An sRGB colour, each part 0 to 255.
struct Color {
  constexpr Color(std::uint8_t red_part, std::uint8_t green_part, std::uint8_t blue_part) noexcept
      : red(red_part), green(green_part), blue(blue_part) {}

  std::uint8_t red, green, blue;
};

// The panel is dark because the yellow and cyan of the paper's figures are too pale on white.
inline constexpr Color page_color{255, 255, 255};
inline constexpr Color panel_color{16, 19, 24};
inline constexpr Color text_color{24, 28, 34};
inline constexpr Color muted_text_color{92, 100, 110};
inline constexpr Color panel_text_color{232, 236, 240};
inline constexpr Color range_ring_color{150, 160, 172};
inline constexpr Color zone_line_color{235, 240, 245};
inline constexpr Color contour_color{88, 58, 38};

/// Colours of text and marks on top of a panel: the ink, and the edge or box behind it.
struct PanelInk {
  Color ink, backing;
};
inline constexpr PanelInk dark_panel_ink{panel_text_color, panel_color};
inline constexpr PanelInk map_ink{text_color, page_color};

/// A rectangle of the image, pixels; x to the right, y down, (x, y) is its upper left corner.
struct Rectangle {
  constexpr Rectangle(double left, double top, double width_of, double height_of) noexcept
      : x(left), y(top), width(width_of), height(height_of) {}

  double x, y, width, height;

  [[nodiscard]] double right() const noexcept { return x + width; }
  [[nodiscard]] double bottom() const noexcept { return y + height; }
  [[nodiscard]] double center_x() const noexcept { return x + width / 2; }
  [[nodiscard]] double center_y() const noexcept { return y + height / 2; }
};

/// An opaque image in memory that Cairo draws into. Not thread-safe.
class Canvas {
 public:
  /// Both sizes must be 1 to 32,767 pixels. Throws std::bad_alloc.
  Canvas(int width, int height);

  /// The Cairo context for shapes and text.
  [[nodiscard]] cairo_t* context() const noexcept { return context_.get(); }

  /// Pixels in memory, 0x00RRGGBB, row by row, for drawing without Cairo. They may only be used
  /// between begin_pixels() and end_pixels(), without calls to Cairo in between.
  struct Pixels {
    std::span<std::uint32_t> data;
    std::size_t row_length;  ///< pixels from one row to the next, at least the width
  };
  [[nodiscard]] Pixels begin_pixels() const noexcept;
  void end_pixels() const noexcept;

  /// The image as the bytes of a PNG file. Throws std::bad_alloc.
  [[nodiscard]] std::vector<std::byte> png() const;

 private:
  struct Release {
    void operator()(cairo_surface_t* surface) const noexcept { cairo_surface_destroy(surface); }
    void operator()(cairo_t* context) const noexcept { cairo_destroy(context); }
  };
  std::unique_ptr<cairo_surface_t, Release> surface_;
  std::unique_ptr<cairo_t, Release> context_;
};

/// Sets the colour of subsequent drawing; `opacity` is 0 to 1.
void set_color(cairo_t* context, Color color, double opacity = 1) noexcept;

/// Appends a rectangle to the path, with corners rounded by `radius` pixels.
void add_rectangle(cairo_t* context, const Rectangle& rectangle, double radius = 0) noexcept;

/// Fills a rectangle with a colour.
void fill(const Canvas& canvas, const Rectangle& rectangle, Color color) noexcept;

/// Positions of the parts of an image with one panel.
struct Layout {
  double unit;        ///< pixels of this image per pixel of the default size; scales all sizes
  Rectangle heading;  ///< title and subtitle
  Rectangle panel;    ///< the bird's-eye view
  Rectangle legend;
};

/// Distance between rows of the legend, in pixels of the default image size.
inline constexpr double legend_row_height = 78;

Layout arrange(int width, int height, int legend_rows) noexcept;

/// Positions of the parts of an image with several panels. The panels are square, with a caption of
/// two lines below each.
struct PanelGrid {
  double unit;  ///< as in Layout, for text
  int height;   ///< of the image, pixels
  Rectangle heading;
  std::vector<Rectangle> panels;  ///< row by row
  Rectangle legend;
};

/// Height of the caption below a panel, in pixels of the default image size.
inline constexpr double caption_height = 84;

/// Arranges the panels in rows of one to three.
PanelGrid arrange_panels(int width, std::size_t panels);

/// Bird's-eye view of the sensor frame: x (forward) points up, y (left) points left, and the origin
/// is in the middle of the panel.
class TopView {
 public:
  /// `range`: metres from the origin to the nearest edges of the panel.
  TopView(const Rectangle& panel, double range) noexcept
      : panel_(panel), scale_(std::min(panel.width, panel.height) / (2 * range)) {}

  [[nodiscard]] const Rectangle& panel() const noexcept { return panel_; }
  [[nodiscard]] double pixels_per_metre() const noexcept { return scale_; }

  /// Position of (x, y), metres, in the image: pixels from its left and top edges. Any value if a
  /// coordinate is not finite.
  [[nodiscard]] double column(double y) const noexcept { return panel_.center_x() - scale_ * y; }
  [[nodiscard]] double row(double x) const noexcept { return panel_.center_y() - scale_ * x; }

  /// Sets Cairo's coordinates to metres in the sensor frame, until cairo_identity_matrix().
  void use_metres(cairo_t* context) const noexcept {
    cairo_matrix_t metres;
    cairo_matrix_init(&metres, 0, -scale_, -scale_, 0, panel_.center_x(), panel_.center_y());
    cairo_set_matrix(context, &metres);
  }

 private:
  Rectangle panel_;
  double scale_;
};

/// invalid_argument with "image: " before the message.
Status refuse(std::string message);

}  // namespace flagstone::render
