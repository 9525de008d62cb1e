// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "library/core/buffer.hpp"

namespace flagstone::surface {

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
