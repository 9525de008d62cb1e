// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "flagstone/cloud_view.hpp"
#include "flagstone/ground_map.hpp"
#include "flagstone/mount.hpp"

namespace flagstone::app {

/// A scan in the level frame of its mounting pose, the frame of its surface, which GroundMap and
/// LabelVote expect. Reuses its memory for the next scan. Not thread-safe.
class LevelScan {
 public:
  /// `pose` is the pose of the frame of `cloud` in metres: a point p is at rotation * (scale * p) +
  /// position. A cloud that is level already is not copied, and must then stay valid. `mount.up`
  /// must not be zero. Throws std::bad_alloc.
  void set(CloudView cloud, const Mount& mount, const Pose& pose);

  [[nodiscard]] CloudView cloud() const noexcept { return cloud_; }

  /// The pose of the level frame in the world frame.
  [[nodiscard]] const Pose& pose() const noexcept { return pose_; }

 private:
  std::vector<float> xyz_;
  CloudView cloud_;
  Pose pose_;
};

}  // namespace flagstone::app
