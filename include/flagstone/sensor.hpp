// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace flagstone {

/// A LiDAR as data: where its beams point, how far they reach, how high it usually stands.
///
/// Settings are derived from it (`PatchworkConfig::for_sensor`, `SurfaceConfig::for_sensor`), the
/// simulator casts its beams, and `flagstone doctor` compares scans with those that are known. A
/// sensor of one's own is a TOML file with these fields; see docs/reference/sensors.md.
struct Sensor {
  std::string name;   ///< short, for the command line: "hdl-64e"
  std::string title;  ///< maker and model

  /// Degrees above the horizontal, -90 to 90, highest first, 1 to 1,024: one per beam, or for a
  /// rosette the upper and the lower edge of its field of view.
  std::vector<double> elevations;

  /// Firings of every beam in one scan, evenly spaced; points of one scan for a rosette. 1 to
  /// 1,000,000.
  int firings = 0;

  /// Edges of the field of view, degrees counter-clockwise from straight ahead, -180 to 360; from
  /// begin to end are at most 360. A spinning sensor sees 0 to 360.
  double azimuth_begin = 0;
  double azimuth_end = 360;  ///< above azimuth_begin, degrees as it

  /// Turns that each of two prisms makes in a scan, negative against the clock, for sensors that
  /// draw a rosette; empty for those with beams.
  std::vector<double> rosette{};

  double min_range = 0;    ///< nearer echoes are not reported, metres, 0 to 1,000
  double max_range = 0;    ///< metres, above min_range, up to 1,000
  double range_sigma = 0;  ///< standard deviation of a measured range, metres, 0 to 10
  double height = 0;       ///< h_s where nobody says otherwise: above the ground, metres, 0 to 100

  /// Does it look in all directions?
  [[nodiscard]] bool sees_all_around() const noexcept { return azimuth_end - azimuth_begin >= 360; }

  /// Does it draw a rosette instead of rings?
  [[nodiscard]] bool draws_rosette() const noexcept { return !rosette.empty(); }

  /// Throws std::invalid_argument naming the field, its value and the range allowed, for the first
  /// value out of range.
  void check() const;

  /// The known sensor of that name, in upper or lower case. Throws std::invalid_argument naming
  /// those there are.
  static const Sensor& named(std::string_view name);

  /// The sensors that are known by name, those of folder sensors/.
  static std::span<const Sensor> known();
};

}  // namespace flagstone
