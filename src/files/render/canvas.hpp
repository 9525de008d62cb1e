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

// A dark panel, since the yellow and cyan of the paper's figures are too pale to read on white.
inline constexpr Color page_color{255, 255, 255};
inline constexpr Color panel_color{16, 19, 24};
inline constexpr Color text_color{24, 28, 34};
inline constexpr Color muted_text_color{92, 100, 110};
inline constexpr Color panel_text_color{232, 236, 240};
inline constexpr Color range_ring_color{150, 160, 172};
inline constexpr Color zone_line_color{235, 240, 245};
inline constexpr Color contour_color{88, 58, 38};

/// What is written and drawn on top of a panel: its colour and that of the edge or box around it.
struct PanelInk {
  Color ink, backing;
};
inline constexpr PanelInk dark_panel_ink{panel_text_color, panel_color};
inline constexpr PanelInk map_ink{text_color, page_color};

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

/// Where the parts of the picture stand.
struct Layout {
  double unit;        ///< pixels of this picture per pixel of the default one, for sizes and widths
  Rectangle heading;  ///< title and subtitle
  Rectangle panel;    ///< the view from above
  Rectangle legend;
};

/// From one row of the legend to the next, in pixels of the default picture.
inline constexpr double legend_row_height = 78;

Layout arrange(int width, int height, int legend_rows) noexcept;

/// Where the parts of a picture of several panels stand. The panels are square, with a caption of
/// two lines under each.
struct PanelGrid {
  double unit;  ///< as in Layout, for text
  int height;   ///< of the picture, pixels
  Rectangle heading;
  std::vector<Rectangle> panels;  ///< row by row
  Rectangle legend;
};

/// Room for a panel's caption, from its lower edge, in pixels of the default picture.
inline constexpr double caption_height = 84;

/// At most three panels, and at least one, in a row.
PanelGrid arrange_panels(int width, std::size_t panels);

/// The sensor frame seen from above: x, forward, up and y, left, to the left; the origin in the
/// middle of the panel.
class TopView {
 public:
  /// `range`: metres from the origin to the nearest edges of the panel.
  TopView(const Rectangle& panel, double range) noexcept
      : panel_(panel), scale_(std::min(panel.width, panel.height) / (2 * range)) {}

  [[nodiscard]] const Rectangle& panel() const noexcept { return panel_; }
  [[nodiscard]] double pixels_per_metre() const noexcept { return scale_; }

  /// Where metres (x, y) lie in the picture, pixels from its left and top edge; anything for what
  /// is not finite.
  [[nodiscard]] double column(double y) const noexcept { return panel_.center_x() - scale_ * y; }
  [[nodiscard]] double row(double x) const noexcept { return panel_.center_y() - scale_ * x; }

  /// Makes Cairo's coordinates metres in the sensor frame, until cairo_identity_matrix().
  void use_metres(cairo_t* context) const noexcept {
    cairo_matrix_t metres;
    cairo_matrix_init(&metres, 0, -scale_, -scale_, 0, panel_.center_x(), panel_.center_y());
    cairo_set_matrix(context, &metres);
  }

 private:
  Rectangle panel_;
  double scale_;
};

/// invalid_argument, "picture: " before the message.
Status refuse(std::string message);

}  // namespace flagstone::render
