// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "library/core/buffer.hpp"

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

/// Gives a grid the heights and confidences of the one it lies in, whose cells are twice as wide
/// and of which it covers as much or less, around the same middle.
void upsample(const Grid& coarse, const Grid& fine) noexcept;

/// Adds corrections to heights, by cell, metres. Where something else borders the grid (`inner`),
/// they fade to nothing at the outermost cells, so that the surface has no step there. Confidence
/// becomes the larger of what it was and that of the correction.
void correct(const float* corrections, const float* confidences, bool inner,
             const Grid& grid) noexcept;

/// Fills the gaps of a grid (Gortler, Grzeszczuk, Szeliski, Cohen, The Lumigraph, SIGGRAPH 1996,
/// section 3.4): weighted means are pulled into ever coarser grids, of half as many cells a side,
/// and pushed back where a finer grid knows less.
class PullPush {
 public:
  /// For grids of up to `width` x `width` cells, an even number. May throw std::bad_alloc.
  explicit PullPush(std::size_t width);

  /// Replaces the values, row by row, by filled ones. A cell whose weight is `full` or more keeps
  /// its value; one with less takes the rest from around it, one with none all. Without any weight
  /// all values become 0.
  ///
  /// Weights become confidences: 1 where a cell keeps its value, half of what the coarser grid has
  /// where it has none of its own.
  void fill(float* values, float* weights, std::size_t width, float full) noexcept;

 private:
  /// Grids of half, a quarter, ... of the width. Each is framed by one cell on all sides that
  /// repeats its edge.
  Buffer<float> values_;
  Buffer<float> weights_;
};

}  // namespace flagstone::surface
