// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "files/render/canvas.hpp"

namespace flagstone::render {

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

}  // namespace flagstone::render
