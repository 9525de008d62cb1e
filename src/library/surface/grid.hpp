// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

namespace flagstone::surface {

/// A square grid of heights centred on the sensor, in working memory; see GroundSurface::Grid.
struct Grid {
  float cell = 0;                ///< side of a cell, metres
  std::size_t width = 0;         ///< cells along a side, even
  float* heights = nullptr;      ///< metres, row by row
  float* confidences = nullptr;  ///< 0 to 1

  [[nodiscard]] float extent() const noexcept { return static_cast<float>(width) * cell / 2; }
  [[nodiscard]] std::size_t size() const noexcept { return width * width; }

  /// x of the centres of a column, or y of those of a row, metres.
  [[nodiscard]] float center(std::size_t index) const noexcept {
    return (static_cast<float>(index) + 0.5f) * cell - extent();
  }
};

}  // namespace flagstone::surface
