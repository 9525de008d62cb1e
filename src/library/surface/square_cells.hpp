// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "flagstone/surface_config.hpp"

namespace flagstone::surface {

/// Side of a block, metres.
inline constexpr int block_size = 8;

/// The surface is refined in levels. A level has cells of side `cell`, metres, and covers |x| and
/// |y| up to `reach`, metres. The coarsest level covers the whole extent.
struct Level {
  float cell;
  float reach;
};
inline constexpr std::size_t level_count = 4;
inline constexpr std::array<Level, level_count> levels = {
    {{2.0f, 200.0f}, {1.0f, 40.0f}, {0.5f, 24.0f}, {0.25f, 8.0f}}};

/// Cells of consecutive numbers: [first, last).
struct CellRange {
  std::uint32_t first, last;
};

/// The x-y plane around the sensor, divided into the square cells of the finest level that covers
/// each position.
///
/// Blocks of 8 m, in rings around the sensor, are divided into 32 x 32, 16 x 16, 8 x 8 or 4 x 4
/// cells. Cells are numbered block by block, ring classes from the inside out, and within a block
/// along a Z-order curve. Every aligned square of 2^k x 2^k cells is therefore a contiguous range
/// of numbers, and so is every cell of a coarser level and every patch.
class SquareCells {
 public:
  explicit SquareCells(const SurfaceConfig& config);

  /// Number of cells. Some numbers in the middle of the outer classes are unused.
  [[nodiscard]] std::uint32_t cell_count() const noexcept { return cell_count_; }

  /// Number for points that belong to no cell: noise, points out of range, invalid points.
  [[nodiscard]] std::uint32_t none() const noexcept { return cell_count_; }

  /// Number of cells plus none().
  [[nodiscard]] std::uint32_t group_count() const noexcept { return cell_count_ + 1; }

  /// The cells cover |x| < extent() and |y| < extent(), metres. The extent is a multiple of the
  /// block size.
  [[nodiscard]] float extent() const noexcept {
    return static_cast<float>(half_blocks_ * block_size);
  }

  /// Number of blocks from the sensor to the edge.
  [[nodiscard]] int half_blocks() const noexcept { return half_blocks_; }

  [[nodiscard]] float max_squared_range() const noexcept { return max_squared_range_; }

  /// Points lower than noise_height() - noise_slope() * range are noise, metres.
  [[nodiscard]] float noise_height() const noexcept { return noise_height_; }
  [[nodiscard]] float noise_slope() const noexcept { return noise_slope_; }

  /// The ring class of a block, 0 (innermost) to 3. `column` and `row` are counted from the edge,
  /// from 0.
  [[nodiscard]] int block_class(int column, int row) const noexcept;

  /// The cells of a block.
  [[nodiscard]] CellRange block(int column, int row) const noexcept;

  /// The cells of all blocks, row by row from the edge.
  [[nodiscard]] std::span<const CellRange> blocks() const noexcept { return blocks_; }

  /// Height of a packed z of 0, metres: 0, or for sensors higher or lower than 16 m a multiple of
  /// 32 m near the expected ground. Small changes of h_s do not change it.
  [[nodiscard]] float packed_zero() const noexcept { return packed_zero_; }

  /// @name Tables by ring of a block, 0 to 7; the last entry applies to all farther rings
  /// The block at (column, row) begins with cell class_bases + n * column + m * row.
  /// @{
  [[nodiscard]] const std::int32_t* class_bases() const noexcept { return class_bases_.data(); }
  /// n | m << 16.
  [[nodiscard]] const std::int32_t* class_strides() const noexcept { return class_strides_.data(); }
  /// The cell with index i along the Z-order curve of cells of 0.25 m has index i >> class_shifts.
  [[nodiscard]] const std::int32_t* class_shifts() const noexcept { return class_shifts_.data(); }
  /// @}

 private:
  int half_blocks_;
  float max_squared_range_;
  float noise_height_;
  float noise_slope_;
  float packed_zero_;
  std::uint32_t cell_count_ = 0;
  std::vector<CellRange> blocks_;
  std::array<std::int32_t, 8> class_bases_{};
  std::array<std::int32_t, 8> class_strides_{};
  std::array<std::int32_t, 8> class_shifts_{};
};

/// Index along the Z-order curve, 0 to 1023, of the cell at (column, row) of a block of 32 x 32
/// cells.
[[nodiscard]] constexpr std::uint32_t z_order(std::uint32_t column, std::uint32_t row) noexcept {
  std::uint32_t index = 0;
  for (std::uint32_t bit = 0; bit < 5; ++bit) {
    index |= (column >> bit & 1U) << (2 * bit) | (row >> bit & 1U) << (2 * bit + 1);
  }
  return index;
}

/// Row and column of a cell of a block.
struct InBlock {
  std::uint8_t row, column;
};

/// Row and column of each cell of a block, by index along the Z-order curve.
inline constexpr auto in_z_order = [] {
  std::array<InBlock, 1024> positions{};
  for (std::uint8_t row = 0; row < 32; ++row) {
    for (std::uint8_t column = 0; column < 32; ++column) {
      positions[z_order(column, row)] = {.row = row, .column = column};
    }
  }
  return positions;
}();

/// Coarse cells of 2 m are numbered block by block in the order of SquareCells::blocks(), and along
/// the Z-order curve within a block.
inline constexpr std::uint32_t coarse_cells_of_block = 16;

/// A square of cells to which one plane is fitted.
struct SquarePatch {
  CellRange cells;
  CellRange coarse;           ///< its coarse cells
  float x, y;                 ///< centre, metres
  float size;                 ///< side, metres: 4 within 24 m of the sensor, 8 beyond
  std::uint16_t size_class;   ///< 0: 4 m, 1: 8 m
  std::uint16_t row, column;  ///< in patches of this size from the edge, y and x ascending
};

/// The patches to which planes are fitted, nearest to the sensor first. Patches whose centre is
/// closer than twice the sensor height (at most 6 m) are omitted: the sensor cannot see the ground
/// there, only a car next to it.
class SquarePatches {
 public:
  SquarePatches(const SurfaceConfig& config, const SquareCells& cells);

  [[nodiscard]] std::span<const SquarePatch> list() const noexcept { return list_; }

 private:
  std::vector<SquarePatch> list_;
};

}  // namespace flagstone::surface
