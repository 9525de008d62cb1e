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

/// The surface is refined level by level. Side of a level's cells, metres, and how far from the
/// sensor along x and y it reaches at most, metres; the coarsest reaches everywhere.
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

/// The plane in square cells around the sensor, as fine as the finest level that reaches there.
///
/// Blocks of 8 m, in rings around the sensor, are cut into 32 x 32, 16 x 16, 8 x 8 or 4 x 4 cells.
/// Cells are numbered block by block, ring classes from the inside out, and within a block along a
/// Z-order curve: every square of 2^k cells, aligned, is a range of numbers. So is every cell of
/// every coarser level, and every patch.
class SquareCells {
 public:
  explicit SquareCells(const SurfaceConfig& config);

  /// Cells in all; some numbers in the middle of outer classes stay unused.
  [[nodiscard]] std::uint32_t cell_count() const noexcept { return cell_count_; }

  /// What points have instead of a cell that belong to none.
  [[nodiscard]] std::uint32_t noise() const noexcept { return cell_count_; }
  [[nodiscard]] std::uint32_t out_of_range() const noexcept { return cell_count_ + 1; }
  [[nodiscard]] std::uint32_t invalid() const noexcept { return cell_count_ + 2; }

  /// Cells and these three.
  [[nodiscard]] std::uint32_t group_count() const noexcept { return cell_count_ + 3; }

  /// The cells cover |x| < extent() and |y| < extent(), metres: whole blocks.
  [[nodiscard]] float extent() const noexcept {
    return static_cast<float>(half_blocks_ * block_size);
  }

  /// Blocks from the sensor to the edge.
  [[nodiscard]] int half_blocks() const noexcept { return half_blocks_; }

  [[nodiscard]] float max_squared_range() const noexcept { return max_squared_range_; }

  /// Points lower than noise_height() - noise_slope() * range are noise, metres.
  [[nodiscard]] float noise_height() const noexcept { return noise_height_; }
  [[nodiscard]] float noise_slope() const noexcept { return noise_slope_; }

  /// The ring class of a block, 0 to 3; `column` and `row` count from 0 at the edge.
  [[nodiscard]] int block_class(int column, int row) const noexcept;

  /// The cells of a block.
  [[nodiscard]] CellRange block(int column, int row) const noexcept;

  /// @name Tables by a block's ring, 0 to 7, the last for all beyond
  /// @{
  /// Blocks in a row of the class.
  [[nodiscard]] const float* class_widths() const noexcept { return class_widths_.data(); }
  /// Number of cell 0 of a block is class_bases + cells_per_block * (row * width + column).
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

/// The cells that lie at (column, row), each 0 to 31, of the quarter metres of a block: their place
/// along the Z-order curve, 0 to 1023.
[[nodiscard]] constexpr std::uint32_t z_order(std::uint32_t column, std::uint32_t row) noexcept {
  std::uint32_t place = 0;
  for (std::uint32_t bit = 0; bit < 5; ++bit) {
    place |= (column >> bit & 1U) << (2 * bit) | (row >> bit & 1U) << (2 * bit + 1);
  }
  return place;
}

/// Reads chunk `chunk` of the cloud, which is no larger than reserved; its bins are square cells.
void read_chunk(CloudView cloud, std::size_t chunk, const SquareCells& cells,
                plane_fits::ScanPoints& scan) noexcept;

/// A square of cells that one plane is fitted to.
struct SquarePatch {
  CellRange cells;
  float x, y;                 ///< centre, metres
  float size;                 ///< side, metres: 4 within 24 m of the sensor, else 8
  std::uint16_t size_class;   ///< 0: 4 m, 1: 8 m
  std::uint16_t row, column;  ///< counted in patches of its size from the edge, y and x ascending
};

/// The patches that planes are fitted to, nearest to the sensor first. Those that the sensor looks
/// down on, within twice its height and 6 m, are left out: only a car beside it can be there.
class SquarePatches {
 public:
  SquarePatches(const SurfaceConfig& config, const SquareCells& cells);

  [[nodiscard]] std::span<const SquarePatch> list() const noexcept { return list_; }

 private:
  std::vector<SquarePatch> list_;
};

}  // namespace flagstone::surface
