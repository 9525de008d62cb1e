// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <unordered_map>
#include <vector>

#include "flagstone/ground_map.hpp"
#include "library/ground_map/tile_index_hash.hpp"

namespace flagstone {

/// Counts, per column of 0.5 m in the world frame, of the scans with a static object in it, and of
/// the scans with empty ground.
class OccupiedColumns {
 public:
  /// Largest distance of points from the sensor, metres.
  static constexpr double reach = 41;

  /// Starts the next scan, of a sensor at (x, y), world frame, metres. May throw std::bad_alloc.
  void start(double x, double y);

  /// Adds a point of that scan, (dx, dy) metres from the sensor along the axes of the world frame,
  /// at most `reach`. `is_object`: it is part of an object, otherwise ground.
  void add(double dx, double dy, bool is_object) noexcept {
    const auto column = static_cast<std::int64_t>(std::floor((x_ + dx) / width)) - first_x_;
    const auto row = static_cast<std::int64_t>(std::floor((y_ + dy) / width)) - first_y_;
    seen_[static_cast<std::size_t>(row * scan_width + column)] |=
        static_cast<std::uint8_t>(is_object ? 2 : 1);
  }

  /// Counts that scan. May throw std::bad_alloc, and then counts nothing.
  void finish();

  /// True if an object was in the column at (x, y) in nearly all scans that measured it.
  [[nodiscard]] bool is_occupied(double x, double y) const noexcept;

  /// Forgets the tiles of columns whose centre is farther than `distance` from (x, y), metres.
  void forget_beyond(double x, double y, double distance) noexcept;

  [[nodiscard]] std::size_t bytes() const noexcept;

 private:
  struct Counts {
    std::uint16_t empty = 0, occupied = 0;  // saturate
  };
  static constexpr std::int64_t tile_width = 64;
  using Tile = std::array<Counts, std::size_t{tile_width} * tile_width>;

  static constexpr double width = 0.5;  // of a column, metres
  static constexpr std::int64_t scan_width = 2 * static_cast<std::int64_t>(reach / width) + 2;

  static TileIndex tile_of(std::int64_t x, std::int64_t y) noexcept;
  static std::size_t index_in_tile(std::int64_t x, std::int64_t y) noexcept;

  std::unordered_map<TileIndex, std::unique_ptr<Tile>, TileIndexHash> tiles_;
  std::vector<std::uint8_t> seen_;  // in the columns around the sensor
  double x_ = 0, y_ = 0;
  std::int64_t first_x_ = 0, first_y_ = 0;  // column of seen_[0]
};

}  // namespace flagstone
