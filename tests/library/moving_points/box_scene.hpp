// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "flagstone/cloud_view.hpp"
#include "flagstone/ground_map.hpp"
#include "flagstone/segmentation.hpp"

namespace flagstone {

/// A box on the ground: centre, length along x, width along y and height, metres.
struct Box {
  double x = 0, y = 0;
  double length = 4, width = 2, height = 1.6;
};

/// A scan of boxes on level ground, by a sensor 1.8 m above it with 32 beams one degree apart, with
/// correct labels and heights.
struct BoxScan {
  static constexpr int no_box = -1;

  BoxScan(const std::vector<Box>& boxes, const Pose& pose);

  [[nodiscard]] CloudView view() const { return {xyz.data(), xyz.size() / 3}; }
  [[nodiscard]] std::size_t size() const { return box_of_points.size(); }

  std::vector<float> xyz;
  std::vector<int> box_of_points;  ///< index of the box, or no_box for ground
  Segmentation result;
};

/// The pose of that sensor at (x, y), looking along the x axis.
Pose sensor_at(double x, double y);

}  // namespace flagstone
