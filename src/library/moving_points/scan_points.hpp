// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "flagstone/cloud_view.hpp"
#include "flagstone/label.hpp"
#include "library/core/buffer.hpp"
#include "library/moving_points/column_grid.hpp"
#include "library/moving_points/directions.hpp"

namespace flagstone {

/// Which points of a scan could move, and how columns divide them.
struct ScanPointsRule {
  /// First two rows of the rotation from the sensor frame to the world frame.
  std::array<float, 6> to_world{};
  /// @name Points that could move
  /// @{
  float max_range = 0;                   ///< exclusive, metres
  float min_height = 0, max_height = 0;  ///< above the ground; exclusive and inclusive, metres
  ColumnGrid objects;                    ///< in which they form objects
  /// @}
  ColumnGrid columns;       ///< in which ground and static objects are counted
  ColumnGrid surroundings;  ///< the same columns, of a larger square
};

/// The points of one scan, prepared in one pass for all later steps. Per point of the scan, in its
/// order.
class ScanPoints {
 public:
  /// May throw std::bad_alloc. The same on every instruction set.
  void read(CloudView cloud, std::span<const Label> labels, std::span<const float> heights,
            const ScanPointsRule& rule);

  /// Points labelled `invalid` or `noise` are at (0, 0, 0).
  [[nodiscard]] const PointArrays& points() const noexcept { return points_; }

  /// 1 for points of static objects, 0 for ground and moving points.
  [[nodiscard]] std::span<const std::uint8_t> is_object() const noexcept {
    return {is_object_.data(), points_.size()};
  }

  /// The columns with a point that is ground or part of an object on it, near the sensor; otherwise
  /// outside: twice the column, plus 1 for an object.
  [[nodiscard]] std::span<const std::uint32_t> in_columns() const noexcept {
    return {in_columns_.data(), points_.size()};
  }

  /// @name The points that could move
  /// @{
  /// Ascending.
  [[nodiscard]] std::span<const std::uint32_t> candidates() const noexcept {
    return {candidates_.data(), candidate_count_};
  }
  /// In ScanPointsRule::objects.
  [[nodiscard]] std::span<const std::uint32_t> candidate_columns() const noexcept {
    return {candidate_columns_.data(), candidate_count_};
  }
  /// In ScanPointsRule::surroundings.
  [[nodiscard]] std::span<const std::uint32_t> candidate_surroundings() const noexcept {
    return {candidate_surroundings_.data(), candidate_count_};
  }
  /// Hashes of the coordinates, 32 bits.
  [[nodiscard]] std::span<const std::uint32_t> candidate_hashes() const noexcept {
    return {candidate_hashes_.data(), candidate_count_};
  }
  /// @}

  /// A point moves: it is not part of a static object.
  void mark_moving(std::size_t k) noexcept {
    is_object_.data()[k] = 0;
    in_columns_.data()[k] = 2 * outside_;
  }

 private:
  PointArrays points_;
  Buffer<std::uint8_t> is_object_;
  Buffer<std::uint32_t> in_columns_;  // 2 * column + is_object
  Buffer<std::uint32_t> candidates_, candidate_columns_, candidate_surroundings_, candidate_hashes_;
  std::size_t candidate_count_ = 0;
  std::uint32_t outside_ = 0;  // of ScanPointsRule::columns
};

}  // namespace flagstone
