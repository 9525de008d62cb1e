// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>

#include "flagstone/mount.hpp"
#include "library/mount/vectors.hpp"

namespace flagstone::doctor {

using mount::Vector3f;

/// How a cloud lies over its ground: which of its axes is up, how that is tilted, where the ground
/// is.
struct FrameOrientation {
  /// Which axis of the cloud is nearest to up: unit length, one coordinate 1 or -1.
  Vector3f axis{0, 0, 1};
  /// What the scan says of the ground, seen from `seen_from` along the axis, metres. Refused
  /// decisions say why no ground was found.
  MountDecision decision{};
  float seen_from = 0;

  /// The same if the axis is up. From afar and on one side a tilt and a slope look alike, and the
  /// height differs.
  MountDecision level{};

  [[nodiscard]] bool is_found() const noexcept { return decision.accepted(); }
  /// Where the ground is at the cloud's origin: along the axis, metres, negative below it. By the
  /// tilt that was found, or as if the axis is up.
  [[nodiscard]] float ground_of_tilt() const noexcept;
  [[nodiscard]] float ground_of_axis() const noexcept;
  /// Degrees between the axis and up.
  [[nodiscard]] double tilt() const noexcept;
};

/// Looks for the ground of `places`, a unit of which is `metres`: below the origin, and if none is
/// there below other places along each axis. Takes each of the six directions of the axes for up
/// and keeps what the points agree on best, z if they agree on it about as well.
FrameOrientation find_stance(std::span<const Vector3f> places, double metres);

}  // namespace flagstone::doctor
