// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "files/render/layout.hpp"

#include <algorithm>
#include <cmath>

#include "files/render/birds_eye.hpp"
#include "files/render/side_by_side.hpp"

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

}  // namespace flagstone::render
