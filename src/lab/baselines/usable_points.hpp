// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "flagstone/cloud_view.hpp"
#include "flagstone/label.hpp"
#include "lab/baselines/coordinates.hpp"
#include "library/core/buffer.hpp"

namespace flagstone::baselines {

/// Maximum absolute coordinate, metres. Points with a larger coordinate are out of range.
inline constexpr float max_coordinate = 10000;

/// The points of a scan that can be fitted, packed and in input order: x[0..n), y[0..n), z[0..n)
/// and their indices in the cloud.
class UsablePoints {
 public:
  /// Reserves memory for `points` points; may throw std::bad_alloc.
  void reserve(std::size_t points);

  /// Copies the points of `cloud` that are finite, not all zero and within max_coordinate. Labels
  /// all other points invalid or out_of_range; other labels are unchanged.
  void gather(CloudView cloud, std::span<Label> labels) noexcept;

  /// Labels the points below `height`, metres, with `label` and removes them.
  void remove_below(float height, Label label, std::span<Label> labels) noexcept;

  [[nodiscard]] std::size_t size() const noexcept { return size_; }
  [[nodiscard]] std::span<const float> x() const noexcept { return {coordinates_.data(), size_}; }
  [[nodiscard]] std::span<const float> y() const noexcept {
    return {coordinates_.data() + capacity_, size_};
  }
  [[nodiscard]] std::span<const float> z() const noexcept {
    return {coordinates_.data() + 2 * capacity_, size_};
  }
  [[nodiscard]] Coordinates coordinates() const noexcept { return {x(), y(), z()}; }
  /// Index in the cloud of each point.
  [[nodiscard]] std::span<const std::uint32_t> index() const noexcept {
    return {index_.data(), size_};
  }

 private:
  Buffer<float> coordinates_;
  Buffer<std::uint32_t> index_;
  std::size_t capacity_ = 0;
  std::size_t size_ = 0;
};

}  // namespace flagstone::baselines
