// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

#include "flagstone/cloud_view.hpp"
#include "flagstone/segmentation.hpp"
#include "flagstone/status.hpp"

namespace flagstone {

struct MeasuredHeight;

/// Pose of a sensor in the world frame: a point p of the scan is at rotation * p + position.
struct Pose {
  /// Rotation matrix, row by row. Its columns are the axes of the sensor in the world frame.
  std::array<double, 9> rotation{1, 0, 0, 0, 1, 0, 0, 0, 1};
  std::array<double, 3> position{};  ///< of the sensor, metres
};

/// Settings of a GroundMap.
struct GroundMapConfig {
  /// Size of a cell, metres, 0.1 to 2.
  double cell = 0.5;
  /// Points farther from the sensor than this are not added, metres, 5 to 100.
  double max_range = 40;
  /// After each scan, tiles farther from the sensor than this are removed, metres, 50 to 1e6.
  /// 0: the map keeps everything.
  double window = 0;
  /// Largest height difference between a scan and the map that is treated as an error of the pose,
  /// metres, 0 to 100. Scans that differ more are added without a correction.
  double max_correction = 1;

  /// Throws std::invalid_argument if a value is out of its range.
  void check() const;
};

/// The correction of a pose in height, pitch and roll that fits a scan to the map.
struct Levelling {
  bool applied = false;   ///< false: too few common cells, or a difference above max_correction
  std::size_t cells = 0;  ///< number of cells that both the scan and the map know
  /// @name Plane to subtract from heights in the world frame
  /// offset + slope_x (x - X) + slope_y (y - Y), where (X, Y) is the position of the sensor. 0 if
  /// not applied.
  /// @{
  double offset = 0;   ///< metres
  double slope_x = 0;  ///< m/m
  double slope_y = 0;  ///< m/m
  /// @}

  /// The correction at (x, y), metres, for a sensor at `position`.
  [[nodiscard]] double at(double x, double y,
                          const std::array<double, 3>& position) const noexcept {
    return offset + slope_x * (x - position[0]) + slope_y * (y - position[1]);
  }
};

/// The ground of a map at one position.
struct MapSample {
  double height = 0;              ///< z of the ground, metres, world frame; NaN if unknown
  std::array<float, 3> normal{};  ///< unit length, z > 0; NaN if unknown
  float slope = 0;  ///< angle between normal and z axis, radians, 0 to pi/2; NaN if unknown
  float deviation =
      0;  ///< expected error of the height (standard deviation), metres; NaN if unknown
  std::uint32_t scans = 0;           ///< scans that agree on the height of the nearest cell
  std::uint32_t contradictions = 0;  ///< scans that measured another height in that cell
  std::uint32_t age = 0;             ///< scans added since the nearest cell was measured last
};

/// The ground along a run, in the world frame: one height per cell, from all scans that saw the
/// cell. Each scan is levelled to the map before it is added, which removes the errors of its pose
/// in height, pitch and roll.
///
/// If a run returns to the same ground, later scans are levelled to the heights of the first pass.
/// A cell keeps two heights, so a wrong one from one scan, such as a car roof, gives way to the
/// height that more scans measured.
///
/// The map does not depend on the order of the points in a scan, nor on threads; it depends on the
/// order of the scans. Not thread-safe while a scan is added; otherwise several threads can read
/// it.
class GroundMap {
 public:
  /// Throws std::invalid_argument if the configuration is invalid.
  explicit GroundMap(const GroundMapConfig& config = {});
  ~GroundMap();
  GroundMap(GroundMap&&) noexcept;
  GroundMap& operator=(GroundMap&&) noexcept;

  /// The configuration.
  [[nodiscard]] const GroundMapConfig& config() const noexcept;

  /// Fits a scan to the map without adding it.
  ///
  /// `result` is the segmentation of `cloud` by a method with a ground surface. The z axis of the
  /// cloud should point up within about 30 degrees. invalid_argument if the sizes differ, the
  /// result has no heights, or the pose is not finite or not a rotation; out_of_memory. Never
  /// throws.
  Status level(CloudView cloud, const Segmentation& result, const Pose& pose, Levelling& levelling);

  /// Fits a scan to the map, adds it and returns how it was fitted. Errors as level(), after which
  /// the map is as before.
  Status add(CloudView cloud, const Segmentation& result, const Pose& pose, Levelling& levelling);

  /// The ground at (x, y), world frame, metres: interpolated between the four nearest cells, if
  /// those that are known have more than half of the weight. Any value is allowed.
  [[nodiscard]] MapSample at(double x, double y) const noexcept;

  /// Same as at(x, y).height, but faster.
  [[nodiscard]] double height(double x, double y) const noexcept;

  /// Number of scans added.
  [[nodiscard]] std::size_t scans() const noexcept;

  /// Number of cells with a height.
  [[nodiscard]] std::size_t cells() const noexcept;

  /// Memory in use, bytes.
  [[nodiscard]] std::size_t bytes() const noexcept;

 private:
  class Tiles;
  class Builder;

  Status fit(CloudView cloud, const Segmentation& result, const Pose& pose,
             std::span<const MeasuredHeight>& heights, Levelling& levelling);

  std::unique_ptr<Tiles> tiles_;
  std::unique_ptr<Builder> builder_;
};

}  // namespace flagstone
