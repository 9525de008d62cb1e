// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>

#include "library/core/buffer.hpp"

namespace flagstone::surface {

/// Maximum width of a grid, cells.
inline constexpr std::size_t most_width = 256;

/// A square grid of heights centred on the sensor, in memory owned by the caller; see
/// GroundSurface::Grid.
struct Grid {
  float cell = 0;                ///< side of a cell, metres
  std::size_t width = 0;         ///< cells along a side, even
  float* heights = nullptr;      ///< metres, row by row
  float* confidences = nullptr;  ///< 0 to 1

  [[nodiscard]] float extent() const noexcept { return static_cast<float>(width) * cell / 2; }
  [[nodiscard]] std::size_t size() const noexcept { return width * width; }

  /// x of the centres of a column, or y of the centres of a row, metres.
  [[nodiscard]] float center(std::size_t index) const noexcept {
    return (static_cast<float>(index) + 0.5f) * cell - extent();
  }
};

/// Interpolates heights and confidences of `coarse` onto `fine` (bilinear). Cells of `coarse` are
/// twice as wide. Both grids have the same centre, and `coarse` covers `fine`.
void upsample(const Grid& coarse, const Grid& fine) noexcept;

/// Finishes a grid of up to 256 x 256 cells: heights with a confidence below `least` become unknown
/// (NaN), in the grid too. Writes the heights and their calibrated confidences, 0 for unknown ones.
///
/// The calibrated confidence is the probability that the height is within 10 cm of the ground. A
/// height that was filled in is wrong by about the slope of the surface times the distance to the
/// next measurement, so the odds are a(c) / (0.013 + slope). a is fitted to simulated scenes; see
/// docs/benchmarks/accuracy.md. After the heights and the confidences of the grid 16 more must be
/// readable.
void finish(const Grid& grid, float least, float* heights, float* confidences) noexcept;

/// Values and weights of a grid in memory, cell (row, column) at index row * stride + column.
struct FilledGrid {
  float* values;
  float* weights;
  std::size_t width;
  std::size_t stride;
};

/// Fills the gaps of a grid with pull-push (Gortler, Grzeszczuk, Szeliski, Cohen, The Lumigraph,
/// SIGGRAPH 1996, section 3.4). Pull computes weighted means on coarser and coarser grids, each
/// with half as many cells per side. Push fills cells with too little weight from the next coarser
/// grid.
class PullPush {
 public:
  /// For grids of up to `width` x `width` cells. May throw std::bad_alloc.
  explicit PullPush(std::size_t width);

  /// Fills `values`, row by row, in place; `width` must be even. Cells with a weight of at least
  /// `full` keep their values. Cells with less weight are blended with the values around them, and
  /// cells without weight take those values. If no cell has weight, all values become 0.
  ///
  /// Replaces weights by confidences: 1 for a cell that keeps its value, and half the confidence of
  /// the coarser grid for a cell without weight.
  void fill(float* values, float* weights, std::size_t width, float full) noexcept;

  /// Fills corrections, as fill(), and adds them to the heights of `grid`, by cell, metres. If the
  /// grid lies inside a coarser one (`inner`), corrections fade to zero at the outermost cells, so
  /// that the surface has no step there. The confidence of a cell becomes the maximum of the cell's
  /// and the correction's confidence. Afterwards all corrections and weights are 0.
  void correct(float* corrections, float* weights, float full, bool inner,
               const Grid& grid) noexcept;

 private:
  /// The grid to fill, then grids of half, a quarter, ... of its width.
  using Grids = std::array<FilledGrid, 10>;

  /// Returns the number of grids.
  std::size_t list_grids(float* values, float* weights, std::size_t width, Grids& grids) noexcept;

  /// Of all grids but the first.
  Buffer<float> values_;
  Buffer<float> weights_;
};

}  // namespace flagstone::surface
