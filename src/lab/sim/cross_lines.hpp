// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "lab/sim/geometry.hpp"

namespace flagstone::sim {

/// A straight line across a road: the middle of the road, and the direction to the left.
struct CrossLine {
  double x = 0, y = 0;            ///< metres
  double left_x = 0, left_y = 1;  ///< of length 1

  /// The position `t` metres to the left of the middle.
  [[nodiscard]] Vector3 at(double t) const noexcept { return {x + t * left_x, y + t * left_y, 0}; }

  /// Distance of a position ahead of the line, metres.
  [[nodiscard]] double ahead(double px, double py) const noexcept {
    return (px - x) * left_y - (py - y) * left_x;
  }
  /// Distance of a position to the left of the middle, metres.
  [[nodiscard]] double aside(double px, double py) const noexcept {
    return (px - x) * left_x + (py - y) * left_y;
  }
};

/// The cross lines of a bent road, at most 2 m apart, and a search for the pair around a position.
class CrossLines {
 public:
  CrossLines() = default;

  /// `across` is the part of the lines that is searched. If the road is `closed`, the last line is
  /// the first one again.
  CrossLines(std::vector<CrossLine> lines, Interval across, bool closed);

  [[nodiscard]] bool empty() const noexcept { return lines_.empty(); }
  [[nodiscard]] bool closed() const noexcept { return closed_; }
  [[nodiscard]] const CrossLine& operator[](std::size_t index) const noexcept {
    return lines_[index];
  }

  /// Index of the line before (x, y), which is between it and the next one. Beyond the ends of the
  /// road, the first or the last but one; far to its side, the nearest.
  [[nodiscard]] std::size_t before(double x, double y) const noexcept;

 private:
  [[nodiscard]] std::size_t guess(double x, double y) const noexcept;

  static constexpr std::uint32_t nothing = ~std::uint32_t{0};

  std::vector<CrossLine> lines_;
  bool closed_ = false;
  double low_x_ = 0, low_y_ = 0;        // corner of the buckets
  std::size_t width_ = 0, depth_ = 0;   // number of buckets along x and y
  std::vector<std::uint32_t> buckets_;  // a line in or near each
};

}  // namespace flagstone::sim
