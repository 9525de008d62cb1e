// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>

#include "files/render/canvas.hpp"

namespace flagstone::render {

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

}  // namespace flagstone::render
