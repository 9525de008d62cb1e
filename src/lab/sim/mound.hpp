// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

namespace flagstone::sim {

/// A round rise of the land, or a dip if its height is below 0, of limited reach. It is nowhere
/// steeper than 1.54 times height / radius.
struct Mound {
  double x, t;            ///< middle, metres; t is y or the distance from a path
  double radius, height;  ///< metres

  [[nodiscard]] double at(double px, double pt) const noexcept {
    const double dx = (px - x) / radius;
    const double dt = (pt - t) / radius;
    const double inside = 1 - dx * dx - dt * dt;
    return inside > 0 ? height * inside * inside : 0;
  }
};

}  // namespace flagstone::sim
