// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "flagstone/sensor.hpp"
#include "lab/sim/geometry.hpp"

namespace flagstone::sim {

/// Where the beams of one scan point, in the sensor's frame and in the order of the scan's file.
///
/// Rings and grids: row by row, the highest first, each from azimuth_begin counter-clockwise; all
/// around, the firings divide the turn; in a narrower field of view the first and the last point
/// along its edges. A rosette: as they are fired, one row. Two prisms bend the beam by a quarter of
/// the field of view each and turn at speeds of their own.
class Beams {
 public:
  /// `number` counts the scans of a rosette: each begins where the one before ended. Rings and
  /// grids are the same in every scan. `sensor` is valid, see Sensor::check().
  explicit Beams(const Sensor& sensor, int number = 0);

  [[nodiscard]] std::size_t size() const noexcept { return directions_.size(); }

  /// Beams of one row: fired one after the other.
  [[nodiscard]] std::size_t row_length() const noexcept { return row_length_; }

  /// Of length 1; x forward, y left, z up.
  [[nodiscard]] Vector3 operator[](std::size_t beam) const noexcept { return directions_[beam]; }

 private:
  void add_rows(const Sensor& sensor);
  void add_rosette(const Sensor& sensor, int number);

  std::size_t row_length_;
  std::vector<Vector3> directions_;
};

}  // namespace flagstone::sim
