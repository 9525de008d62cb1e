// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>

#include "flagstone/mount.hpp"
#include "library/mount/vectors.hpp"

namespace flagstone::doctor {

using mount::Vector3f;

/// Orientation of a cloud relative to its ground: the axis that is up, the tilt, the ground height.
struct FrameOrientation {
  /// The axis of the cloud that is closest to up: unit length, one coordinate is 1 or -1.
  Vector3f axis{0, 0, 1};
  /// The estimate of the ground for a sensor at `seen_from` along the axis, metres. A rejected
  /// decision has the reason why no ground was found.
  MountDecision decision{};
  float seen_from = 0;

  /// The estimate with the axis as up. Far away, or on one side only, a tilt cannot be
  /// distinguished from a slope, but the two give different heights.
  MountDecision level{};

  [[nodiscard]] bool is_found() const noexcept { return decision.accepted(); }
  /// Height of the ground at the origin of the cloud: metres along the axis, negative below it.
  /// With the estimated tilt, or with the axis as up.
  [[nodiscard]] float ground_of_tilt() const noexcept;
  [[nodiscard]] float ground_of_axis() const noexcept;
  /// Degrees between the axis and up.
  [[nodiscard]] double tilt() const noexcept;
};

/// Finds the ground of `places`, whose unit is `metres`: below the origin, otherwise below other
/// positions along each axis. Tries each of the six axis directions as up and returns the one with
/// the best score; z is preferred if the scores are similar.
FrameOrientation find_orientation(std::span<const Vector3f> places, double metres);

}  // namespace flagstone::doctor
