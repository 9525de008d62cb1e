// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "library/core/buffer.hpp"

namespace flagstone::surface {

/// A cell of a grid and its points.
struct OccupiedCell {
  std::uint32_t first;  ///< index of its first point
  std::uint32_t count;
  std::uint32_t place;  ///< row * width + column
};

/// Cells, one array per property.
struct OccupiedCells {
  const std::uint32_t* firsts;
  const std::uint32_t* counts;
  const std::uint32_t* places;
  std::size_t size;  ///< number of cells

  [[nodiscard]] OccupiedCell operator[](std::size_t i) const noexcept {
    return {.first = firsts[i], .count = counts[i], .place = places[i]};
  }

  /// Up to `count` cells from `first` on.
  [[nodiscard]] OccupiedCells part(std::size_t first, std::size_t count) const noexcept {
    return {.firsts = firsts + first,
            .counts = counts + first,
            .places = places + first,
            .size = std::min(count, size - first)};
  }
};

/// Cells by their number of points: up to 16, up to 32, more. Of a large cell, a sample is used
/// that does not depend on the order of its points.
enum class CellSize : std::uint8_t { small, medium, large };
inline constexpr std::size_t cell_sizes = 3;
inline constexpr std::uint32_t small_cell = 16;
inline constexpr std::uint32_t medium_cell = 32;

/// A block of a level.
struct LevelBlock {
  std::uint32_t first_cell;   ///< number of its first cell
  std::uint32_t step;         ///< numbers per cell of the level
  std::uint32_t first_place;  ///< place of its first cell
};

/// The cells of a level with at least three points, by size.
class CellLists {
 public:
  /// Reserves memory for up to `cells` cells. May throw std::bad_alloc.
  void reserve(std::size_t cells);

  /// Lists the cells of blocks. `begins`: index of the first point of each numbered cell, and of
  /// the next one. `places`: for each cell of a block along the Z-order curve, the distance from
  /// the first cell in the grid; a multiple of 16, at most 1024.
  void list(std::span<const LevelBlock> blocks, std::span<const std::uint32_t> places,
            const std::uint32_t* begins) noexcept;

  [[nodiscard]] OccupiedCells cells(CellSize size) const noexcept {
    const Columns& columns = columns_[static_cast<std::size_t>(size)];
    return {.firsts = columns.firsts.data(),
            .counts = columns.counts.data(),
            .places = columns.places.data(),
            .size = columns.size};
  }

 private:
  struct Columns {
    Buffer<std::uint32_t> firsts, counts, places;
    std::size_t size = 0;
  };
  std::array<Columns, cell_sizes> columns_;
};

}  // namespace flagstone::surface
