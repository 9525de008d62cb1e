// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "flagstone/cloud_view.hpp"
#include "flagstone/label.hpp"
#include "lab/eval/confusion.hpp"
#include "lab/eval/protocol.hpp"
#include "library/core/truth.hpp"

namespace flagstone::eval {

/// Upper ends of the bands of horizontal range that are scored apart, metres; the first begins at
/// 0.
inline constexpr std::array<float, 4> range_bands = {10, 20, 40, 80};

/// Side of the cells of the bird's-eye view, metres. They cover the square out to the last band.
inline constexpr float cell_size = 0.5f;

/// One method's labels of one scan compared with the truth.
struct Score {
  Confusion points;                                      ///< over all points
  std::array<Confusion, range_bands.size()> by_range{};  ///< points of each band
  Confusion by_area;  ///< each cell counts once, divided among its points
};

/// What is true of each point of a scan, and where it counts. One per thread, used again: its
/// memory is kept.
class ScanTruth {
 public:
  /// `classes` holds one id per point of `cloud`.
  void set(const Protocol& protocol, CloudView cloud, std::span<const std::uint32_t> classes);

  [[nodiscard]] std::span<const Truth> truth() const noexcept { return truth_; }

  /// Scores one label per point of that cloud.
  [[nodiscard]] Score score(std::span<const Label> labels) const noexcept;

 private:
  std::vector<Truth> truth_;
  std::vector<std::uint8_t> groups_;        // per point: band and truth
  std::vector<std::uint32_t> cells_;        // per point
  std::vector<std::uint32_t> cell_points_;  // per cell: scored points
  std::vector<float> shares_;               // per cell: what each of its points counts
};

}  // namespace flagstone::eval
