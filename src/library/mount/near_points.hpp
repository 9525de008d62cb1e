// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "flagstone/cloud_view.hpp"
#include "flagstone/mount.hpp"
#include "library/mount/vectors.hpp"

namespace flagstone::mount {

/// A point, metres from the sensor, with z along the expected up direction.
struct NearPoint {
  float x, y, z;
  /// Larger near the vehicle, because these points determine the ground below it. Smaller if the
  /// cube of the point contains fewer points than other cubes at the same range.
  float weight;
};

/// The points of a scan that can be ground near the vehicle. Space within the reach is divided into
/// cubes, with one point per cube, so that the density of beams has no influence.
class NearPoints {
 public:
  /// Number of cubes along a side of the cube that encloses the reach.
  static constexpr std::size_t cubes = 64;
  static constexpr float centre = 32;  ///< half of `cubes`
  static constexpr std::size_t most = 16384;

  /// Allocates all memory.
  NearPoints(const MountLimits& limits, bool looks_for_tilt);

  /// Finds the points within `reach` metres of the sensor. Uses scale and origin of `mount`;
  /// `level` brings the expected up direction to z. The span is valid until the next call.
  std::span<const NearPoint> find(CloudView cloud, const Mount& mount, const Turn& level,
                                  float reach) noexcept;

 private:
  static constexpr std::uint16_t none = 0xffff;
  static_assert(most < none);

  void weigh(std::size_t found, float reach) noexcept;

  float nearest_square_;
  float steepest_;                    // sine of the maximum elevation of ground
  std::vector<std::uint16_t> slots_;  // index of the point of each cube
  std::vector<NearPoint> points_;
  std::vector<std::uint32_t> counts_;  // number of points in the cube of each point
};

}  // namespace flagstone::mount
