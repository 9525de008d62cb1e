// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "lab/baselines/cascaded_beams.hpp"

namespace flagstone::baselines {

/// The first stage: a scan as rings by columns, in which what stands upright shows by consecutive
/// rings of a column falling together.
class RangeImage {
 public:
  RangeImage(const Beams& beams, const CascadedConfig& config);

  /// An image without points.
  void clear() noexcept;

  /// Which cell a point belongs in.
  [[nodiscard]] std::size_t cell(std::uint32_t column, std::uint16_t ring) const noexcept {
    return column * rings_ + ring;
  }

  /// Puts a point at this range and height, metres, into a cell. The first point of a cell stands
  /// for all of them.
  void add(std::size_t cell, float range, float height) noexcept;

  /// Finds what stands upright, column by column.
  void find_upright(const Beams& beams) noexcept;

  /// Did find_upright find it in this cell?
  [[nodiscard]] bool is_upright(std::size_t cell) const noexcept { return cells_[cell].upright; }

 private:
  struct Cell {
    float range;
    float height;
    bool occupied;
    bool upright;
  };
  /// Rings first to last, one after the other, that are closer together than on any ground.
  struct Group {
    std::size_t first, last;
    float lowest, highest;
  };

  void search_column(Cell* column, const Beams& beams) const noexcept;
  void mark(Cell* column, const Group& group) const noexcept;

  std::size_t rings_;
  float min_object_height_;
  std::vector<Cell> cells_;  ///< column by column, in each the lowest ring first
};

}  // namespace flagstone::baselines
