// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "lab/baselines/cascaded_beams.hpp"

namespace flagstone::baselines {

/// The first stage: a range image of rings by columns. Upright objects bring consecutive rings of a
/// column close together.
class RangeImage {
 public:
  RangeImage(const Beams& beams, const CascadedConfig& config);

  /// Removes all points.
  void clear() noexcept;

  /// The cell of a point.
  [[nodiscard]] std::size_t cell(std::uint32_t column, std::uint16_t ring) const noexcept {
    return column * rings_ + ring;
  }

  /// Adds a point with this range and height, metres, to a cell. Only the first point of each cell
  /// is used.
  void add(std::size_t cell, float range, float height) noexcept;

  /// Finds upright objects, column by column.
  void find_upright(const Beams& beams) noexcept;

  /// Whether find_upright() found an upright object in this cell.
  [[nodiscard]] bool is_upright(std::size_t cell) const noexcept { return cells_[cell].upright; }

 private:
  struct Cell {
    float range;
    float height;
    bool occupied;
    bool upright;
  };
  /// Consecutive rings, `first` to `last`, that are closer together than on ground.
  struct Group {
    std::size_t first, last;
    float lowest, highest;
  };

  void search_column(Cell* column, const Beams& beams) const noexcept;
  void mark(Cell* column, const Group& group) const noexcept;

  std::size_t rings_;
  float min_object_height_;
  std::vector<Cell> cells_;  ///< column by column, lowest ring first
};

}  // namespace flagstone::baselines
