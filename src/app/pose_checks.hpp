// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <deque>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "flagstone/ground_map.hpp"

namespace flagstone::app {

enum class PoseProblemKind {
  not_finite,      ///< a number is NaN or infinite, or beyond 10,000 km
  not_a_rotation,  ///< off by more than 1e-3
  tilt,            ///< the z axis is more than 45 degrees from that of the other scans
  position,        ///< the position jumps
  rotation,        ///< the rotation jumps
  speed,           ///< most of the run is faster than 70 m/s: wrong units
  calibration,     ///< the poses do not have the axes of the sensor
  world_frame,     ///< the z axis of the world frame does not point up
};

/// A problem of the poses of a run.
struct PoseProblem {
  PoseProblemKind kind = PoseProblemKind::not_finite;
  std::size_t first = 0;  ///< index of the first affected scan; for a jump, the scan before it
  std::size_t last = 0;   ///< index of the last affected scan; for a jump, the scan after it
  std::string message{};  ///< one line without a location
};

/// The message with the names of its scans: "scans 000004 to 000007: the position jumps ...".
std::string to_line(const PoseProblem& problem, std::span<const std::string> scan_names);

/// How the pose of one scan can be used.
struct PoseUse {
  bool usable = false;   ///< false: segment the scan alone
  std::size_t part = 0;  ///< poses of different parts do not fit together: map them separately
};

/// The result of check_poses().
struct PoseChecks {
  std::vector<PoseProblem> problems;  ///< in the order of their first scans
  std::vector<PoseUse> scans;         ///< one per scan
  std::size_t parts = 0;              ///< number of parts; 0 if no pose is usable
};

/// Checks the poses of a run.
///
/// - A pose that is not finite, is not a rotation, or is tilted against the others, and up to three
///   consecutive poses that are off while those before and after fit together, are not usable.
/// - A jump splits the run in two parts. A step is a jump if it is above 70 m/s or differs from the
///   steps before and after in a way that no vehicle moves: at 10 scans per second by more than
///   about 0.5 m or 5.5 degrees, at lower rates by more.
/// - Nothing is usable if the speed, the direction of motion or the up axis shows that all poses
///   are wrong.
///
/// `times`: seconds, one per pose, NaN if unknown; or empty. If they do not increase they are not
/// used, and the steps are compared with one another only. `from_camera`: the poses were converted
/// with calib.txt; only changes the messages. Nothing is printed; messages have no location.
PoseChecks check_poses(std::span<const std::optional<Pose>> poses, std::span<const double> times,
                       bool from_camera = false);

/// Judges from the results of GroundMap::level whether the poses of scans are right, scan by scan.
/// It detects what the poses alone cannot show, such as a wrong pitch at a low rate.
class LevellingJudge {
 public:
  /// The scans that later results depend on, at most ten of each kind, oldest first.
  struct State {
    std::deque<Levelling> fitting;  ///< the last scans that fitted
    std::deque<Levelling> misfits;  ///< scans in a row that did not fit, but fit together
  };

  LevellingJudge() = default;
  /// Continues another one from its state().
  explicit LevellingJudge(State state) noexcept : state_(std::move(state)) {}

  /// True if the scan fits the map as well as the last ones, or if it has fewer than 100 cells in
  /// common with the map. False if it could not be levelled, or if its offset or slope differs from
  /// the median of the last ten scans that fitted by more than 0.3 m or 0.07 m/m (4 degrees). A
  /// second storey above the map does not fit either. After ten scans in a row that do not fit, but
  /// could be levelled and need the same correction, that correction is the usual one: the run has
  /// returned to its first scans with another error of its poses.
  bool fits(const Levelling& levelling);

  [[nodiscard]] const State& state() const noexcept { return state_; }

 private:
  State state_;
};

}  // namespace flagstone::app
