// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace flagstone {

/// Description of a LiDAR: beam directions, range and usual mounting height.
///
/// `PatchworkConfig::for_sensor` and `SurfaceConfig::for_sensor` derive settings from it, the
/// simulator casts its beams, and `flagstone doctor` compares scans with the known sensors.
/// Describe your own sensor in a TOML file with these fields; see docs/reference/sensors.md.
struct Sensor {
  std::string name;   ///< short name for the command line, such as "hdl-64e"
  std::string title;  ///< manufacturer and model

  /// Elevation of each beam above the horizontal, degrees, -90 to 90, highest first, 1 to 1,024
  /// beams. For a rosette: the upper and the lower edge of the field of view.
  std::vector<double> elevations;

  /// Number of firings of each beam per scan, evenly spaced, 1 to 1,000,000. For a rosette: number
  /// of points per scan.
  int firings = 0;

  /// Start of the horizontal field of view, degrees counter-clockwise from the forward direction,
  /// -180 to 360.
  double azimuth_begin = 0;
  /// End of the horizontal field of view, degrees, above azimuth_begin, up to azimuth_begin + 360
  /// and up to 360. A spinning sensor covers 0 to 360.
  double azimuth_end = 360;

  /// Turns per scan of each of the two prisms of a rosette-scanning sensor; negative values turn
  /// counter-clockwise, as seen from the sensor. Empty for sensors with beams.
  std::vector<double> rosette{};

  double min_range = 0;    ///< minimum range of a return, metres, 0 to 1,000
  double max_range = 0;    ///< maximum range of a return, metres, above min_range, up to 1,000
  double range_sigma = 0;  ///< standard deviation of a measured range, metres, 0 to 10
  double height = 0;       ///< h_s: usual height of the sensor above the ground, metres, 0 to 100

  /// True if the horizontal field of view is 360 degrees.
  [[nodiscard]] bool sees_all_around() const noexcept { return azimuth_end - azimuth_begin >= 360; }

  /// True if the sensor scans a rosette instead of rings.
  [[nodiscard]] bool draws_rosette() const noexcept { return !rosette.empty(); }

  /// Checks all values. Throws std::invalid_argument naming the field, its value and the allowed
  /// range, for the first value out of range.
  void check() const;

  /// The known sensor with that name, case-insensitive. The reference is valid until the program
  /// ends. Throws std::invalid_argument listing the known sensors if there is none with that name.
  static const Sensor& named(std::string_view name);

  /// All known sensors: those in the directory sensors/ of the source tree. The span is valid
  /// until the program ends.
  static std::span<const Sensor> known();
};

}  // namespace flagstone
