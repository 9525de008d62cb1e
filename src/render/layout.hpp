// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include "render/canvas.hpp"

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

}  // namespace flagstone::render
