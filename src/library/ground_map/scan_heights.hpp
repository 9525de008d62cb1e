// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "flagstone/cloud_view.hpp"
#include "flagstone/ground_map.hpp"
#include "flagstone/segmentation.hpp"
#include "library/ground_map/tiles.hpp"

namespace flagstone {

/// The height that one scan measures for a cell of the world.
struct MeasuredHeight {
  CellIndex cell;
  float dx = 0, dy = 0;  ///< from the sensor to the centre of the cell, world frame, metres
  float range = 0;       ///< horizontal, in the frame of the sensor, metres
  double height = 0;     ///< z of the ground in the middle of the cell, world frame, metres
  float variance = 0;    ///< of the height, m^2
};

/// Computes the heights of one scan after another and reuses its memory. Does not depend on the
/// order of the points.
class ScanHeights {
 public:
  /// Only points within this distance of the surface of their scan measure the ground, metres.
  static constexpr float max_deviation = 0.08F;

  /// The heights of all cells with ground points within `config.max_range`, row by row. They are
  /// valid until the next call. `cloud` and `result` must have the same size. May throw
  /// std::bad_alloc.
  std::span<const MeasuredHeight> measure(CloudView cloud, const Segmentation& result,
                                          const Pose& pose, const GroundMapConfig& config);

 private:
  // Sums over the ground points of a cell. Integers, so that the order does not matter.
  struct Sums {
    std::int64_t height = 0;  // above the surface of the scan
    std::int64_t z = 0;       // of the surface, world frame, above the sensor
    std::uint32_t points = 0;
  };

  std::vector<Sums> sums_;
  std::vector<MeasuredHeight> heights_;
};

}  // namespace flagstone
