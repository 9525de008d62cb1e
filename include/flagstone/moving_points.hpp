// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "flagstone/cloud_view.hpp"
#include "flagstone/ground_map.hpp"
#include "flagstone/segmentation.hpp"
#include "flagstone/status.hpp"

namespace flagstone {

/// Settings of MovingPoints.
struct MovingPointsConfig {
  /// Angle between neighbouring beams of the sensor, degrees, 0.1 to 5. 0: measured in the first
  /// scan that is added.
  double beam_spacing = 0;
  double max_range = 80;  ///< points farther from the sensor are never moving, metres, 5 to 100
  /// Points lower than this above the ground are never moving, metres, 0 to 2.
  float min_height = 0.1F;
  /// Points higher than this above the ground are never moving, metres, 1 to 100. The default is
  /// above the largest height of road vehicles.
  float max_height = 4.5F;
  /// Time after which find() is called at the latest, seconds, 0 to 10: how long scans are kept
  /// longer than add() needs them. With 8.5, scans are compared with later ones as far as with
  /// earlier ones.
  double delay = 2;
  /// After each scan, static objects farther from the sensor than this are forgotten, metres, 100
  /// to 1e6. 0: nothing is forgotten.
  double window = 0;

  /// Throws std::invalid_argument if a value is out of its range.
  void check() const;
};

/// Connected moving points of one scan, such as a vehicle or a person.
struct MovingObject {
  std::size_t points = 0;  ///< number of its points
  /// Fraction of the looks from other scans that saw through its points, of those that measured
  /// something, 0 to 1.
  float confidence = 0;
  std::array<float, 3> min{};  ///< smallest coordinates, sensor frame, metres
  std::array<float, 3> max{};  ///< largest coordinates, sensor frame, metres
};

/// The moving points of one scan. Pass the same object to every call: its memory is reused.
struct MovingMask {
  /// Per point, in input order: 0 if it is not known to move, otherwise the number of its object,
  /// from 1.
  std::vector<std::uint32_t> objects_of_points;
  std::vector<MovingObject> objects;  ///< number 1 first
};

/// Finds the points of a run that move, by comparing scans. If another scan measured something
/// behind a point, the point was not there at that time. Several such looks make a point moving,
/// and moving points close to each other an object.
///
/// A scan is compared with those 0.3 to 8 s before and after it, as far as they have been added.
/// add() finds the points that are known to move at once; find() finds nearly all of them 2 s
/// later.
///
/// The result does not depend on the order of the points in a scan, nor on the instruction set; it
/// depends on the order of the calls. Not thread-safe.
class MovingPoints {
 public:
  /// Time around a scan in which other scans help to find its moving points, seconds.
  static constexpr double reach = 8.5;

  /// Throws std::invalid_argument if the configuration is invalid.
  explicit MovingPoints(const MovingPointsConfig& config = {});
  ~MovingPoints();
  MovingPoints(MovingPoints&&) noexcept;
  MovingPoints& operator=(MovingPoints&&) noexcept;

  /// Finds the moving points of a scan with the help of earlier scans, and adds the scan.
  ///
  /// `result` is the segmentation of `cloud` by a method that computes heights, `levelling` the
  /// result of GroundMap::level or add for this scan, `time` its time in seconds, later than that
  /// of the scan before. Scans older than `reach` and the delay are forgotten. invalid_argument if
  /// the sizes differ, the pose is invalid (see GroundMap) or the time is not later; out_of_memory.
  /// Never throws.
  Status add(CloudView cloud, const Segmentation& result, const Pose& pose,
             const Levelling& levelling, double time, MovingMask& mask);

  /// Finds the moving points of a scan that was added before, with the help of all scans around it.
  /// Arguments and errors as for add(); also invalid_argument if no scan of this time is in memory.
  Status find(CloudView cloud, const Segmentation& result, const Pose& pose,
              const Levelling& levelling, double time, MovingMask& mask);

  /// The scans in memory and the static objects as bytes, which from_bytes() reads on any machine:
  /// later calls give the same results as without the break. Does not contain settings other than
  /// the angle between beams. out_of_memory; `bytes` is then empty. Never throws.
  Status to_bytes(std::vector<std::byte>& bytes) const;

  /// Replaces the scans in memory and the static objects. The bytes are checked, so they may come
  /// from anywhere: bad_file with the offset if they are damaged, of another version or of another
  /// setting `beam_spacing`; out_of_memory; the object is then as before. Never throws.
  Status from_bytes(std::span<const std::byte> bytes);

  /// The angle between beams in use, degrees; 0 before the first scan.
  [[nodiscard]] double beam_spacing() const noexcept;

  /// Number of scans in memory.
  [[nodiscard]] std::size_t scans() const noexcept;

  /// Memory in use, bytes.
  [[nodiscard]] std::size_t bytes() const noexcept;

 private:
  class Finder;

  std::unique_ptr<Finder> finder_;
};

}  // namespace flagstone
