// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>

#include "flagstone/cloud_view.hpp"

namespace flagstone {

/// How the frame that a cloud is given in stands to the ground.
///
/// A point p of the cloud lies at `scale * p - origin` metres from the sensor. Turned the shortest
/// way that brings `up` to z, that is its place in the level frame: metres, the origin in the
/// sensor, z up, the ground below the sensor at z = -sensor_height.
struct Mount {
  /// h_s: from the sensor down to the ground along `up`, metres, -100 to 100.
  float sensor_height = 1.73f;
  /// Where up is in the cloud's frame: {0, 0, 1} for a level one, minus the measured gravity of an
  /// IMU for any other. Any length but 0; its direction counts.
  std::array<float, 3> up{0, 0, 1};
  /// Where the sensor is in the cloud's frame, metres, each -10,000 to 10,000: {0, 0, 1.8} for a
  /// cloud whose frame lies on the ground 1.8 m below it.
  std::array<float, 3> origin{0, 0, 0};
  /// Metres a unit of the cloud, 1e-6 to 1e6: 0.001 for millimetres.
  float scale = 1;
};

/// Where the height of the sensor is taken from.
enum class HeightSource : std::uint8_t {
  fixed,     ///< from the given mount
  estimate,  ///< from the first scan that tells it, from then on; until then the given mount's
  track,     ///< from every scan that tells it, smoothed
};

/// Where `up` is taken from.
enum class TiltSource : std::uint8_t {
  off,       ///< up is z, whatever the given mount says
  fixed,     ///< from the given mount
  estimate,  ///< from the scans, as the height is, looked for around the given mount's
};

/// Name as configurations spell it, e.g. "estimate".
const char* to_string(HeightSource height) noexcept;
/// Name as configurations spell it, e.g. "fixed".
const char* to_string(TiltSource tilt) noexcept;

/// What is believed of an estimate.
struct MountLimits {
  float min_height = 0.15f;     ///< metres above the ground, 0.01 to 100
  float max_height = 6;         ///< metres, more than `min_height`, up to 100
  float max_tilt = 32;          ///< degrees between `up` and the given mount's, 0 to 45
  float min_confidence = 0.5f;  ///< 0 to 1
  /// Points nearer than this are the own vehicle, metres, 0 to 60.
  float ego_radius = 2.7f;
  /// Points farther than this say nothing about the ground below the vehicle, metres; 2 to 100, and
  /// at least 1.5 times `ego_radius`. Where the ground begins so far away that it is badly told
  /// within it, 2.5 times as far is looked.
  float reach = 16;
};

/// How `track` smooths. The state is the mount and how many scans have told it: the first counts in
/// full, the k-th with 1 / k, and once there are `window` of them each with 1 / `window`.
struct MountTracking {
  int window = 20;  ///< scans, 1 to 10,000
  /// A height that differs by more from the state is an outlier and not followed; metres, above 0,
  /// up to 100.
  float max_height_step = 0.25f;
  /// The same for the direction of `up`; degrees, above 0, up to 90.
  float max_tilt_step = 5;
  /// So many outliers on end, all within `max_height_step` and `max_tilt_step` of the one before,
  /// are the new state; 1 to 10,000.
  int patience = 10;
};

/// How the mount is known.
struct MountSettings {
  HeightSource height = HeightSource::fixed;  ///< where the height is taken from
  TiltSource tilt = TiltSource::off;          ///< where `up` is taken from
  Mount mount{};                              ///< what is given
  MountLimits limits{};                       ///< what is believed of an estimate
  MountTracking tracking{};                   ///< how `track` smooths

  /// Is anything to be found out from scans?
  [[nodiscard]] bool estimates() const noexcept {
    return height != HeightSource::fixed || tilt == TiltSource::estimate;
  }
  /// Does it change from scan to scan for as long as there are scans?
  [[nodiscard]] bool tracks() const noexcept { return height == HeightSource::track; }

  /// Throws std::invalid_argument naming the field, its value and the range allowed, for the first
  /// value out of range.
  void check() const;
};

/// What was made of a scan, and why.
enum class MountVerdict : std::uint8_t {
  fixed,           ///< nothing was asked of this scan: the mount is given, or already estimated
  accepted,        ///< the scan tells the mount
  too_few_points,  ///< refused: hardly any points where ground can be
  no_plane,        ///< refused: no plane that near points agree on
  obstructed,      ///< refused: what agrees is the foot of what stands above it: walls, bushes
  points_below,    ///< refused: too much lies below it
  one_sided,       ///< refused: seen in too few directions to tell how it lies
  height_limit,    ///< refused: the height is not within the limits
  tilt_limit,      ///< refused: the tilt is beyond the limit
  outlier,         ///< refused: too far from what scans before have told (`track`)
};

/// Name of a verdict, e.g. "points_below".
const char* to_string(MountVerdict verdict) noexcept;

/// The decision about one scan and the numbers it stands on.
struct MountDecision {
  MountVerdict verdict = MountVerdict::fixed;  ///< what was decided, and why
  /// What the scan says, if `accepted`; what it seems to say, if refused for another reason than
  /// too few points; else the given mount.
  Mount mount{};
  float confidence = 0;  ///< 0 to 1: the product of what each number below lets believe
  float tilt = 0;        ///< degrees between `mount.up` and the cloud's z axis

  std::uint32_t points =
      0;                    ///< places of 0.5 m (1.25 m from afar) with a point where ground can be
  std::uint32_t cells = 0;  ///< cells of 1 m (2.5 m from afar) with ground in them
  float free = 0;           ///< share of them with nothing standing on it, 0 to 1
  float below = 0;          ///< what lies below the ground, as a share of both, 0 to 1
  float spread = 0;         ///< root mean square distance of ground from its plane, metres
  int directions = 0;       ///< of sixteen around the sensor, how many show ground
  int seen = 0;             ///< and how many show anything

  /// Does the scan tell the mount?
  [[nodiscard]] bool accepted() const noexcept { return verdict == MountVerdict::accepted; }
};

/// The decision in one plain sentence without a full stop, e.g. "sensor 1.74 m above the ground,
/// confidence 0.93". May throw std::bad_alloc.
std::string to_sentence(const MountDecision& decision);

/// Finds height and tilt of a sensor from one scan: the ground under and near the vehicle is what
/// counts. The vehicle stands on it, so on a slope an untilted mount has its up along z.
///
/// The same cloud gives the same bits, whatever came before; any bit pattern is allowed in the
/// coordinates. All memory is taken when it is made. One object serves one thread at a time.
class MountEstimator {
 public:
  /// Estimates the height, and `up` too if `settings.tilt` is `estimate`; else `up` is as `tilt`
  /// says. `settings.height` is not looked at. Throws what MountSettings::check throws, or
  /// std::bad_alloc.
  explicit MountEstimator(const MountSettings& settings = {});
  ~MountEstimator();
  MountEstimator(MountEstimator&&) noexcept;
  MountEstimator& operator=(MountEstimator&&) noexcept;

  /// What one scan says. A null cloud that claims points has none.
  [[nodiscard]] MountDecision estimate(CloudView cloud) noexcept;

  /// The settings it was made with.
  [[nodiscard]] const MountSettings& settings() const noexcept;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace flagstone
