// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <unordered_map>
#include <vector>

#include "flagstone/ground_map.hpp"
#include "library/ground_map/state_bytes.hpp"
#include "library/ground_map/tile_index_hash.hpp"
#include "library/moving_points/column_grid.hpp"

namespace flagstone {

/// Counts, per column of 0.5 m in the world frame, of the scans with a static object in it, and of
/// the scans with empty ground.
class OccupiedColumns {
 public:
  /// Starts the next scan, of a sensor at (x, y), world frame, metres. May throw std::bad_alloc.
  void start(double x, double y);

  /// The columns around that sensor.
  [[nodiscard]] const ColumnGrid& grid() const noexcept { return scan_.grid; }

  /// Adds points of that scan by their columns in grid(), which may be outside: twice the column,
  /// plus 1 for a part of an object; otherwise ground.
  void add(std::span<const std::uint32_t> in_columns) noexcept {
    for (const std::uint32_t k : in_columns) seen_[k] = 1;
  }

  /// Counts that scan. May throw std::bad_alloc, and then counts nothing.
  void finish();

  /// Prepares is_occupied() for points around (x, y), world frame, metres. May throw
  /// std::bad_alloc.
  void look_around(double x, double y);

  /// The columns up to 102 m to each side of the position of look_around().
  [[nodiscard]] const ColumnGrid& surroundings() const noexcept { return around_.grid; }

  /// True if an object was in nearly all scans that measured this column of surroundings(), which
  /// may be outside.
  [[nodiscard]] bool is_occupied(std::uint32_t column) const noexcept {
    return occupied_[column] != 0;
  }

  /// Forgets the tiles of columns whose centre is farther than `distance` from (x, y), metres.
  void forget_beyond(double x, double y, double distance) noexcept;

  /// Appends the counts to a state. May throw std::bad_alloc.
  void write(StateWriter& writer) const;

  /// Reads the counts of a state. bad_file if they are damaged; the counts are then unspecified.
  /// May throw std::bad_alloc.
  Status read(StateReader& reader);

  [[nodiscard]] std::size_t bytes() const noexcept;

 private:
  struct Counts {
    std::uint16_t empty = 0, occupied = 0;  // saturate
  };
  static constexpr std::int64_t tile_width = 64;
  using Tile = std::array<Counts, std::size_t{tile_width} * tile_width>;

  static constexpr double width = 0.5;  // of a column, metres

  /// A square of columns around a position.
  struct Window {
    std::int64_t first_x = 0, first_y = 0;  // the first column
    ColumnGrid grid;

    Window() = default;
    Window(double x, double y, std::uint32_t columns) noexcept;
  };
  static constexpr std::uint32_t scan_width = 166;    // columns
  static constexpr std::uint32_t window_width = 414;  // columns

  static TileIndex tile_of(std::int64_t x, std::int64_t y) noexcept;
  static std::size_t index_in_tile(std::int64_t x, std::int64_t y) noexcept;

  std::unordered_map<TileIndex, std::unique_ptr<Tile>, TileIndexHash> tiles_;
  Window scan_;
  std::vector<std::uint8_t> seen_;  // ground and object in the columns of scan_, and outside
  Window around_;
  std::vector<std::uint8_t> occupied_;  // the columns of around_, and outside
};

}  // namespace flagstone
