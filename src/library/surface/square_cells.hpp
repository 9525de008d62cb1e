// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "flagstone/cloud_view.hpp"
#include "flagstone/surface_config.hpp"
#include "library/plane_fits/scan_points.hpp"

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

  /// Numbers for points that belong to no cell.
  [[nodiscard]] std::uint32_t noise() const noexcept { return cell_count_; }
  [[nodiscard]] std::uint32_t out_of_range() const noexcept { return cell_count_ + 1; }
  [[nodiscard]] std::uint32_t invalid() const noexcept { return cell_count_ + 2; }

  /// Number of cells plus these three.
  [[nodiscard]] std::uint32_t group_count() const noexcept { return cell_count_ + 3; }

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

  /// @name Tables by ring of a block, 0 to 7; the last entry applies to all farther rings
  /// @{
  /// Blocks per row of the class.
  [[nodiscard]] const float* class_widths() const noexcept { return class_widths_.data(); }
  /// The first cell of a block has number class_bases + cells_per_block * (row * width + column).
  [[nodiscard]] const float* class_bases() const noexcept { return class_bases_.data(); }
  [[nodiscard]] const float* cells_per_block() const noexcept { return cells_per_block_.data(); }
  /// @}

 private:
  int half_blocks_;
  float max_squared_range_;
  float noise_height_;
  float noise_slope_;
  std::uint32_t cell_count_ = 0;
  std::array<float, 8> class_widths_{};
  std::array<float, 8> class_bases_{};
  std::array<float, 8> cells_per_block_{};
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

/// Reads chunk `chunk` of the cloud into `scan`, with square cells as bins. `scan` must have room
/// for the cloud.
void read_chunk(CloudView cloud, std::size_t chunk, const SquareCells& cells,
                plane_fits::ScanPoints& scan) noexcept;

/// A square of cells to which one plane is fitted.
struct SquarePatch {
  CellRange cells;
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
