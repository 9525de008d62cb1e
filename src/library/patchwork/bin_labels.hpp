// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

#include "flagstone/label.hpp"
#include "flagstone/patchwork_config.hpp"
#include "library/core/buffer.hpp"
#include "library/plane_fits/bin_batch.hpp"
#include "library/plane_fits/bin_groups.hpp"
#include "library/plane_fits/ground_sets.hpp"

namespace flagstone::patchwork {

/// Number of points of a bin per label.
struct LabelCounts {
  std::uint32_t ground = 0;
  std::uint32_t noise = 0;
  std::uint32_t lower_ground =
      0;  ///< ground points in a separate plane below; included in `ground`
};

/// Labels the points of bins, in the order of the cloud.
class BinLabels {
 public:
  explicit BinLabels(const PatchworkConfig& config) noexcept
      : depth_(config.lower_plane_margin + config.distance_margin),
        finds_lower_ground_(std::isfinite(config.lower_plane_margin)) {}

  /// Reserves memory for bins with up to `points` points. May throw std::bad_alloc.
  void reserve(std::size_t points) { packed_.reserve(points + 128); }

  /// Labels the points of bin `i` of the batch. Points in its final ground set are `ground`, eq.
  /// (12); points above it are `nonground`. Points farther below the plane than the lower plane
  /// margin are `ground` if they form a separate plane, otherwise `noise`.
  LabelCounts write(const plane_fits::BinBatch& batch, std::size_t i, plane_fits::GroundSet set,
                    const plane_fits::BinGroups& groups, std::span<Label> labels) noexcept;

  /// Gives all points of a bin the same label. Returns the number of points.
  static std::uint32_t fill(const plane_fits::BinGroups& groups, std::uint32_t bin, Label label,
                            std::span<Label> labels) noexcept;

 private:
  float depth_;  ///< depth of the final ground set below its top, metres
  bool finds_lower_ground_;
  Buffer<std::uint8_t> packed_;  ///< labels of one bin, in the order of its points
};

}  // namespace flagstone::patchwork
