// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

namespace flagstone {

/// Settings of the method `surface`. They are the same for every sensor but for its height.
struct SurfaceConfig {
  /// h_s: height of the sensor above the ground, metres, -100 to 100.
  float sensor_height = 1.73f;

  /// Points farther away than this are out of range; metres, 8 to 200.
  float max_range = 100.0f;

  /// Throws std::invalid_argument naming the field, its value and the range allowed, for the first
  /// value out of range.
  void check() const;
};

}  // namespace flagstone
