// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "library/moving_points/column_grid.hpp"

namespace flagstone {

/// Groups the points of one scan into objects, in columns of 0.4 m, and finds those that move.
class MovingObjects {
 public:
  /// The result of all looks, for one point.
  enum class Evidence : std::uint8_t { none, moving, fixed };

  /// The columns.
  static constexpr ColumnGrid grid{
      .offset_x = 102.4F, .offset_y = 102.4F, .per_metre = 2.5F, .width = 512};

  /// Starts with the column of each point; no point is outside of the grid. May throw
  /// std::bad_alloc.
  void start(std::span<const std::uint32_t> columns);

  /// One point in this many of the column needs evidence: 1 in a column of few points.
  [[nodiscard]] std::uint32_t points_per_sample(std::uint32_t column) const noexcept {
    constexpr std::uint32_t max_samples = 32;
    return (points_[column] + max_samples - 1) / max_samples;
  }

  /// A point with its evidence. It speaks for points_per_sample() points of its column.
  struct Sample {
    std::uint32_t column = 0;
    Evidence evidence = Evidence::none;
  };

  /// Finds the moving objects among the points of start(). The order of points and samples does not
  /// matter. May throw std::bad_alloc.
  void find(std::span<const Sample> samples);

  /// The number of the moving object in a column, from 1, or 0. Objects are numbered by the first
  /// of their columns.
  [[nodiscard]] std::uint32_t object_in(std::uint32_t column) const noexcept {
    return cells_[column].object;
  }

  /// Number of moving objects.
  [[nodiscard]] std::size_t count() const noexcept { return count_; }

 private:
  struct Cell {
    std::uint16_t moving = 0, fixed = 0;  // saturate
    bool is_moving = false;
    std::uint8_t visit = 0;  // of the last search that reached it
    std::uint32_t object = 0;
  };

  template <class Starts, class Belongs, class Use>
  void for_each_component(const Starts& starts, const Belongs& belongs, const Use& use);
  void mark_seeds();
  void grow();
  void mark_whole_components();
  void number_objects();

  std::vector<std::uint16_t> points_;  // per column; saturates
  std::vector<Cell> cells_;            // per column
  std::vector<std::uint32_t> used_;    // columns with points, ascending
  std::vector<std::uint32_t> component_, open_, grown_;
  std::uint8_t visit_ = 0;
  std::size_t count_ = 0;
};

}  // namespace flagstone
