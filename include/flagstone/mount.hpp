// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>

#include "flagstone/cloud_view.hpp"

namespace flagstone {

/// Mounting pose: height, tilt, origin and scale of the frame of a cloud (the part of the sensor's
/// extrinsic calibration that segmentation needs).
///
/// A point p of the cloud is at `scale * p - origin`, in metres relative to the sensor. The
/// shortest rotation that brings `up` to z transforms it to the level frame: metres, origin at the
/// sensor, z up, ground below the sensor at z = -sensor_height.
struct Mount {
  /// h_s: height of the sensor above the ground along `up`, metres, -100 to 100.
  float sensor_height = 1.73f;
  /// Up direction in the frame of the cloud: {0, 0, 1} if the frame is level, otherwise for example
  /// the negated gravity vector of an IMU. Any length except 0; only the direction is used.
  std::array<float, 3> up{0, 0, 1};
  /// Position of the sensor in the frame of the cloud, metres, each -10,000 to 10,000: {0, 0, 1.8}
  /// if the origin of the frame is on the ground, 1.8 m below the sensor.
  std::array<float, 3> origin{0, 0, 0};
  /// Metres per unit of the cloud, 1e-6 to 1e6: 0.001 for millimetres.
  float scale = 1;
};

/// Source of the height of the sensor.
enum class HeightSource : std::uint8_t {
  fixed,     ///< the configured height
  estimate,  ///< the first accepted estimate; the configured height until then
  track,     ///< the running mean of the accepted estimates of all scans
};

/// Source of the up direction.
enum class TiltSource : std::uint8_t {
  off,       ///< z is up; the configured up direction is ignored
  fixed,     ///< the configured up direction
  estimate,  ///< estimated from the scans, as the height is, near the configured up direction
};

/// Name as spelled in configurations, for example "estimate".
const char* to_string(HeightSource height) noexcept;
/// Name as spelled in configurations, for example "fixed".
const char* to_string(TiltSource tilt) noexcept;

/// Limits of an estimate. Estimates beyond a limit are rejected.
struct MountLimits {
  /// Minimum height above the ground, metres, 0.01 to 100.
  float min_height = 0.15f;
  /// Maximum height above the ground, metres, above `min_height`, up to 100.
  float max_height = 6;
  /// Maximum angle between the estimated and the configured up direction, degrees, 0 to 45.
  float max_tilt = 32;
  /// Minimum confidence of an estimate, 0 to 1.
  float min_confidence = 0.5f;
  /// Points nearer than this belong to the ego vehicle and are ignored; metres, 0 to 60.
  float ego_radius = 2.7f;
  /// Points farther than this are ignored; metres, 2 to 100, and at least 1.5 times `ego_radius`.
  /// If the ground found within this distance is too far away to show the ground below the sensor,
  /// a second pass uses 2.5 times this distance (the distant pass).
  float reach = 16;
};

/// Smoothing of `track`. The state is a running mean: the first accepted scan has weight 1, the
/// k-th has weight 1 / k, and from scan number `window` on every scan has weight 1 / `window`.
struct MountTracking {
  int window = 20;  ///< number of scans in the running mean, 1 to 10,000
  /// An estimate whose height differs from the state by more than this is an outlier and is not
  /// used; metres, above 0, up to 100.
  float max_height_step = 0.25f;
  /// An estimate whose up direction differs from the state by more than this is an outlier and is
  /// not used; degrees, above 0, up to 90.
  float max_tilt_step = 5;
  /// Number of consecutive outliers, each within `max_height_step` and `max_tilt_step` of the
  /// previous one, after which the last of them becomes the new state; 1 to 10,000.
  int patience = 10;
};

/// Sources, values and limits of the mounting pose.
struct MountSettings {
  HeightSource height = HeightSource::fixed;  ///< source of the height
  TiltSource tilt = TiltSource::off;          ///< source of the up direction
  Mount mount{};                              ///< configured mounting pose
  MountLimits limits{};                       ///< limits of an estimate
  MountTracking tracking{};                   ///< smoothing of `track`

  /// True if the height or the tilt is estimated from scans.
  [[nodiscard]] bool estimates() const noexcept {
    return height != HeightSource::fixed || tilt == TiltSource::estimate;
  }
  /// True if the pose is updated with every scan.
  [[nodiscard]] bool tracks() const noexcept { return height == HeightSource::track; }

  /// Checks all values. Throws std::invalid_argument naming the field, its value and the allowed
  /// range, for the first value out of range.
  void check() const;
};

/// Whether the estimate of a scan was accepted, and if not, why.
enum class MountVerdict : std::uint8_t {
  fixed,           ///< no estimate: the pose is configured or was already estimated
  accepted,        ///< the estimate is accepted
  too_few_points,  ///< rejected: too few points where ground can be
  no_plane,        ///< rejected: near points do not fit one plane
  obstructed,      ///< rejected: the plane is at the base of obstacles such as walls and bushes
  points_below,    ///< rejected: too many points below the plane
  one_sided,       ///< rejected: ground is seen in too few directions
  height_limit,    ///< rejected: the height is outside the limits
  tilt_limit,      ///< rejected: the tilt exceeds the limit
  outlier,         ///< rejected: too far from the estimates of previous scans (`track`)
};

/// Name of a `MountVerdict`, for example "points_below".
const char* to_string(MountVerdict verdict) noexcept;

/// The estimate from one scan, whether it was accepted, and the values behind that decision.
struct MountDecision {
  MountVerdict verdict = MountVerdict::fixed;  ///< accepted, or the reason for rejection
  /// The estimate if `accepted`; the rejected estimate if a plane was found; otherwise the
  /// configured mounting pose.
  Mount mount{};
  float confidence = 0;  ///< 0 to 1: a product of factors computed from the values below
  float tilt = 0;        ///< angle between `mount.up` and the z axis of the cloud, degrees

  /// Number of 0.5 m cubes (1.25 m in the distant pass) with a point where ground can be.
  std::uint32_t points = 0;
  std::uint32_t cells = 0;  ///< number of 1 m cells (2.5 m in the distant pass) with ground
  float free = 0;           ///< fraction of the ground cells without an obstacle, 0 to 1
  /// Number of cells below the ground, as a fraction of all cells on and below the ground, 0 to 1.
  float below = 0;
  float spread = 0;    ///< RMS distance of ground points below the plane from the plane, metres
  int directions = 0;  ///< number of directions with ground, of sixteen around the sensor
  int seen = 0;        ///< number of directions with any points, of sixteen

  /// True if the estimate is accepted.
  [[nodiscard]] bool accepted() const noexcept { return verdict == MountVerdict::accepted; }
};

/// The decision as one sentence without a full stop, for example "sensor 1.74 m above the ground,
/// confidence 0.93". Throws std::bad_alloc if memory runs out.
std::string to_sentence(const MountDecision& decision);

/// Estimates the height and tilt of a sensor from the ground near the vehicle in one scan. The
/// vehicle stands on that ground: on a slope, the up direction of an untilted sensor is still z.
///
/// The estimate is deterministic: the same cloud gives bit-identical results, whatever was
/// estimated before. All memory is allocated on construction. Not thread-safe: use one instance per
/// thread.
class MountEstimator {
 public:
  /// Prepares estimates of the height, and of `up` if `settings.tilt` is `estimate`. Otherwise `up`
  /// follows from `settings.tilt`. `settings.height` is ignored. Throws what MountSettings::check
  /// throws, or std::bad_alloc.
  explicit MountEstimator(const MountSettings& settings = {});
  ~MountEstimator();
  MountEstimator(MountEstimator&&) noexcept;
  MountEstimator& operator=(MountEstimator&&) noexcept;

  /// Estimates the mounting pose from one scan. Coordinates may have any value, including NaN,
  /// infinity and denormals. A cloud with a null pointer counts as empty.
  [[nodiscard]] MountDecision estimate(CloudView cloud) noexcept;

  /// The settings passed to the constructor.
  [[nodiscard]] const MountSettings& settings() const noexcept;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace flagstone
