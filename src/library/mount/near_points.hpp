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

/// A place with a point, metres from the sensor, z along the up that is expected.
struct NearPoint {
  float x, y, z;
  /// The nearer to the vehicle, the more it says about the ground it stands on; less where its cube
  /// holds fewer points than those around the sensor do.
  float weight;
};

/// The points of a scan that can be ground near the vehicle: one in each of the cubes that the
/// reach is divided into, so that places count and not the density of beams.
class NearPoints {
 public:
  /// Cubes along a side; the cube that the reach fits in has 64 of them.
  static constexpr std::size_t cubes = 64;
  static constexpr float centre = 32;  ///< half of them
  static constexpr std::size_t most = 16384;

  /// Takes all its memory.
  NearPoints(const MountLimits& limits, bool looks_for_tilt);

  /// Of scale and origin of `mount` and an `up` of unit length; `reach` in metres.
  std::span<const NearPoint> find(CloudView cloud, const Mount& mount, const Turn& level,
                                  float reach) noexcept;

 private:
  static constexpr std::uint16_t none = 0xffff;
  static_assert(most < none);

  void weigh(std::size_t found, float reach) noexcept;

  float nearest_square_;
  float steepest_;                    // sine of the highest elevation that ground can be seen at
  std::vector<std::uint16_t> slots_;  // where the point of each cube is
  std::vector<NearPoint> points_;
  std::vector<std::uint32_t> counts_;  // points in the cube of each
};

}  // namespace flagstone::mount
