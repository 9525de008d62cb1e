// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "flagstone/label.hpp"
#include "library/core/buffer.hpp"
#include "library/plane_fits/bin_batch.hpp"
#include "library/plane_fits/bin_groups.hpp"
#include "library/plane_fits/ground_sets.hpp"

namespace flagstone::patchwork {

/// How many points of a bin got these labels.
struct LabelCounts {
  std::uint32_t ground = 0;
  std::uint32_t noise = 0;
  std::uint32_t sunken = 0;  ///< of the ground, what lies in a plane below the set's
};

/// Labels the points of bins where they stand in the cloud.
class BinLabels {
 public:
  /// Makes room for bins of `points` points; may throw std::bad_alloc.
  void reserve(std::size_t points) { packed_.reserve(points + 128); }

  /// Labels the points of bin `i` of the batch: ground if in the set, noise below it, nonground
  /// above. With `find_sunken`, points below it that lie in a plane of their own are ground too.
  LabelCounts write(const plane_fits::BinBatch& batch, std::size_t i,
                    const plane_fits::GroundSet& set, bool find_sunken,
                    const plane_fits::BinGroups& groups, std::span<Label> labels) noexcept;

  /// Gives all points of a bin one label.
  /// Returns how many they are.
  static std::uint32_t fill(const plane_fits::BinGroups& groups, std::uint32_t bin, Label label,
                            std::span<Label> labels) noexcept;

 private:
  Buffer<std::uint8_t> packed_;  ///< labels of one bin, in the order of its points
};

}  // namespace flagstone::patchwork
