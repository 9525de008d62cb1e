// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <vector>

#include "flagstone/cloud_view.hpp"
#include "flagstone/ground_map.hpp"
#include "flagstone/segmentation.hpp"

namespace flagstone {

/// The height of the ground at (x, y), metres.
using TrueGround = std::function<double(double x, double y)>;

/// Ground at 0 everywhere.
double level_ground(double x, double y);

/// The pose of an upright sensor `above` metres above the ground at (x, y).
Pose upright_pose(const TrueGround& ground, double x, double y, double yaw = 0, double above = 1.8);

/// A perfect scan of a ground: a point every 0.25 m within `reach` metres, all labelled ground,
/// with heights of 0, and their exact surface.
struct GroundScan {
  GroundScan(const TrueGround& ground, const Pose& pose, double reach = 35);

  [[nodiscard]] CloudView view() const { return {xyz.data(), xyz.size() / 3}; }

  std::vector<float> xyz;
  Segmentation result;
};

}  // namespace flagstone
