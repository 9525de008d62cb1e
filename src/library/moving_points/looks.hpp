// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <deque>
#include <vector>

#include "library/moving_points/directions.hpp"
#include "library/moving_points/levelled_pose.hpp"
#include "library/moving_points/range_image.hpp"

namespace flagstone {

/// A scan to look from.
struct ScanView {
  double time = 0;  ///< seconds
  LevelledPose pose;
  RangeImage image;
};

/// Counts of looks from other scans, for one point.
struct LookCounts {
  std::uint8_t through = 0;   ///< the other scan measured something behind the point
  std::uint8_t occupied = 0;  ///< the other scan measured an object at the point
};

/// Selects scans to look from: up to 17 before `time` and 17 after it, 0.3 to 8 s away, closer
/// together near `time`. If the scans cover too little time for eight of these, the intervals are
/// shortened to fit. `scans`
/// in order of time. May throw std::bad_alloc.
void select_views(const std::deque<ScanView>& scans, double time,
                  std::vector<const ScanView*>& selected);

/// Adds a look from one scan at each point. `directions`: of the points, from that scan.
void add_looks(const RangeImage& image, const Directions& directions,
               std::vector<LookCounts>& counts) noexcept;

}  // namespace flagstone
