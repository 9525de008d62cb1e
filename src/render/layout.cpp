// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "render/layout.hpp"

#include <algorithm>
#include <cmath>

#include "render/birds_eye.hpp"

namespace flagstone::render {

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

}  // namespace flagstone::render
