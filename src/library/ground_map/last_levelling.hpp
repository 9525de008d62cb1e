// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>

#include "flagstone/ground_map.hpp"

namespace flagstone {

/// A plane of corrections, as in Levelling.
struct CorrectionPlane {
  double offset = 0, slope_x = 0, slope_y = 0;
};

/// The levelling of the scan that was added to a map last.
///
/// Each scan is levelled to those before it, so that the errors of levelling add up along a run.
/// The errors of most poses do not. Therefore, the map follows the poses over long distances: a
/// correction that many scans need is forgotten little by little.
struct LastLevelling {
  static constexpr double no_position = 1e8;  ///< beyond all valid positions, metres

  CorrectionPlane plane{};
  CorrectionPlane mean{};  ///< of the last scans, so that the noise of single poses averages out
  std::array<double, 2> position{no_position, no_position};  ///< of the sensor, metres

  /// The levelling that is expected of a scan at a pose: the same plane. Nothing if the scan is
  /// more than 20 m away, because it starts another pass.
  [[nodiscard]] Levelling continued_at(const Pose& pose) const noexcept {
    if (!is_same_pass(pose)) return {};
    const double x = pose.position[0] - position[0];
    const double y = pose.position[1] - position[1];
    return {.offset = plane.offset + plane.slope_x * x + plane.slope_y * y,
            .slope_x = plane.slope_x,
            .slope_y = plane.slope_y};
  }

  /// The levelling without the part that the map forgets.
  [[nodiscard]] Levelling without_forgotten(const Pose& pose, Levelling levelling) const noexcept {
    if (!is_same_pass(pose)) return levelling;
    const double forgotten = share(pose, forgetting_distance);
    levelling.offset -= forgotten * mean.offset;
    levelling.slope_x -= forgotten * mean.slope_x;
    levelling.slope_y -= forgotten * mean.slope_y;
    return levelling;
  }

  /// Replaces the last levelling by the levelling of a scan at a pose.
  void replace(const Pose& pose, const Levelling& levelling) noexcept {
    const double weight = is_same_pass(pose) ? share(pose, mean_distance) : 1;
    plane = {
        .offset = levelling.offset, .slope_x = levelling.slope_x, .slope_y = levelling.slope_y};
    mean.offset += weight * (plane.offset - mean.offset);
    mean.slope_x += weight * (plane.slope_x - mean.slope_x);
    mean.slope_y += weight * (plane.slope_y - mean.slope_y);
    position = {pose.position[0], pose.position[1]};
  }

 private:
  static constexpr double forgetting_distance = 100;  // metres
  static constexpr double mean_distance = 25;         // metres

  [[nodiscard]] double step(const Pose& pose) const noexcept {
    return std::hypot(pose.position[0] - position[0], pose.position[1] - position[1]);
  }
  [[nodiscard]] bool is_same_pass(const Pose& pose) const noexcept {
    constexpr double max_step = 20;  // metres
    return step(pose) <= max_step;
  }
  [[nodiscard]] double share(const Pose& pose, double distance) const noexcept {
    return 1 - std::exp(-step(pose) / distance);
  }
};

}  // namespace flagstone
