// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "lab/baselines/usable_points.hpp"
#include "library/core/buffer.hpp"
#include "library/patchwork/concentric_zones.hpp"

namespace flagstone::baselines {

/// Rings of equal width around the sensor, divided into equal sectors. Implemented as one zone of
/// the Concentric Zone Model, which locates points quickly and exactly.
class PolarGrid {
 public:
  /// `rings` rings from `min_range` to `max_range`, metres, and `sectors` sectors, 1 to 3,600; the
  /// first sector begins at azimuth -pi.
  PolarGrid(float min_range, float max_range, int rings, int sectors);

  [[nodiscard]] std::uint32_t rings() const noexcept { return rings_; }
  [[nodiscard]] std::uint32_t sectors() const noexcept { return sectors_; }
  /// rings() * sectors().
  [[nodiscard]] std::uint32_t bin_count() const noexcept { return rings_ * sectors_; }

  /// Reserves memory for `points` points; may throw std::bad_alloc.
  void reserve(std::size_t points) { bins_.reserve(points); }

  /// Returns the bin of each point, ring * sectors() + sector, or at least bin_count() for points
  /// outside the grid.
  std::span<const std::uint32_t> locate(const UsablePoints& points) noexcept;

 private:
  std::uint32_t rings_;
  std::uint32_t sectors_;
  patchwork::ConcentricZones zones_;
  Buffer<std::uint32_t> bins_;
};

}  // namespace flagstone::baselines
