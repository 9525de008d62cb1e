// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "flagstone/sensor.hpp"
#include "lab/sim/geometry.hpp"

namespace flagstone::sim {

/// Directions of the beams of one scan, in the sensor frame and in the order of the scan file.
///
/// Rings and grids are ordered row by row, the highest first, each row counter-clockwise from
/// azimuth_begin. With a field of view of 360 degrees, the firings divide the full turn; otherwise
/// the first and the last firing point along its edges. A rosette is one row in firing order: two
/// prisms, which rotate at different speeds, each bend the beam by a quarter of the field of view.
class Beams {
 public:
  /// `number` counts the scans of a rosette: each continues where the previous one ended. Rings and
  /// grids are the same in every scan. `sensor` must be valid, see Sensor::check().
  explicit Beams(const Sensor& sensor, int number = 0);

  [[nodiscard]] std::size_t size() const noexcept { return directions_.size(); }

  /// Number of beams per row. The beams of a row are fired consecutively.
  [[nodiscard]] std::size_t row_length() const noexcept { return row_length_; }

  /// Direction of a beam, of length 1; x forward, y left, z up.
  [[nodiscard]] Vector3 operator[](std::size_t beam) const noexcept { return directions_[beam]; }

 private:
  void add_rows(const Sensor& sensor);
  void add_rosette(const Sensor& sensor, int number);

  std::size_t row_length_;
  std::vector<Vector3> directions_;
};

}  // namespace flagstone::sim
