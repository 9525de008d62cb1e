// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "flagstone/gravity_aligned_segmenter.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <new>
#include <optional>
#include <stdexcept>
#include <utility>

#include "library/core/buffer.hpp"
#include "library/core/floating_point_mode.hpp"
#include "library/core/setting.hpp"
#include "library/mount/mount_settings.hpp"
#include "library/mount/vectors.hpp"

namespace flagstone::mount {

/// The state that `estimate` and `track` keep from scan to scan.
class MountTrack {
 public:
  /// `mount` is used until the first accepted estimate. Its `up` must have unit length.
  MountTrack(const Mount& mount, bool finds_height, bool finds_tilt, const MountTracking& tracking);

  /// True if an estimate was accepted.
  [[nodiscard]] bool is_told() const noexcept { return told_ > 0; }

  /// Updates the state with the decision about the next scan. If an accepted estimate is an
  /// outlier, its status becomes `outlier` and the state does not change. Rejected estimates are
  /// ignored.
  void take(MountDecision& decision) noexcept;

  [[nodiscard]] const Mount& mount() const noexcept { return mount_; }

  void reset() noexcept;

 private:
  [[nodiscard]] bool is_close(const Mount& a, const Mount& b) const noexcept;
  void begin_with(const Mount& mount) noexcept;
  void move_towards(const Mount& mount) noexcept;

  Mount given_;
  bool finds_height_;
  bool finds_tilt_;
  MountTracking tracking_;
  Mount mount_;
  int told_ = 0;  // number of accepted estimates, up to `window`
  Mount last_outlier_{};
  int outliers_ = 0;  // consecutive outliers, each close to the previous one
};

MountTrack::MountTrack(const Mount& mount, bool finds_height, bool finds_tilt,
                       const MountTracking& tracking)
    : given_(mount),
      finds_height_(finds_height),
      finds_tilt_(finds_tilt),
      tracking_(tracking),
      mount_(mount) {}

void MountTrack::reset() noexcept {
  mount_ = given_;
  told_ = 0;
  outliers_ = 0;
}

bool MountTrack::is_close(const Mount& a, const Mount& b) const noexcept {
  const bool height_is =
      !finds_height_ || std::abs(a.sensor_height - b.sensor_height) <= tracking_.max_height_step;
  return height_is && degrees_between(a.up, b.up) <= tracking_.max_tilt_step;
}

void MountTrack::begin_with(const Mount& mount) noexcept {
  if (finds_height_) mount_.sensor_height = mount.sensor_height;
  if (finds_tilt_) mount_.up = mount.up;
  told_ = 1;
  outliers_ = 0;
}

void MountTrack::move_towards(const Mount& mount) noexcept {
  told_ = std::min(told_ + 1, tracking_.window);
  outliers_ = 0;
  const float share = 1 / static_cast<float>(told_);
  if (finds_height_) mount_.sensor_height += share * (mount.sensor_height - mount_.sensor_height);
  if (!finds_tilt_) return;
  Vector3f up = mount_.up;
  for (std::size_t i = 0; i < 3; ++i) up[i] += share * (mount.up[i] - up[i]);
  mount_.up = unit(up);
}

void MountTrack::take(MountDecision& decision) noexcept {
  if (!decision.accepted()) return;
  if (told_ == 0) {
    begin_with(decision.mount);
  } else if (is_close(decision.mount, mount_)) {
    move_towards(decision.mount);
  } else {
    outliers_ = outliers_ > 0 && is_close(decision.mount, last_outlier_) ? outliers_ + 1 : 1;
    last_outlier_ = decision.mount;
    if (outliers_ < tracking_.patience) {
      decision.verdict = MountVerdict::outlier;
    } else {
      begin_with(decision.mount);
    }
  }
}

/// Transforms clouds to the frame that a method expects, and transforms the results back.
class GravityAlignment {
 public:
  /// The method expects the ground below the sensor at z = -method_height.
  explicit GravityAlignment(float method_height) noexcept : method_height_(method_height) {}

  /// Sets the mounting pose of the next clouds. `mount.up` must have unit length.
  void set(const Mount& mount) noexcept;

  /// True if clouds do not need to be transformed.
  [[nodiscard]] bool is_identity() const noexcept { return is_identity_; }

  /// The cloud in the level frame, with the ground at the height that the method expects. Exactly
  /// the points that were not finite, or all zero, are so afterwards. May throw std::bad_alloc.
  CloudView apply(CloudView cloud);

  /// Transforms patches back to the frame of the cloud, and the ground surface to heights relative
  /// to the sensor.
  void bring_back(Segmentation& result) const noexcept;

 private:
  float method_height_;
  bool is_identity_ = true;
  Mount mount_;
  Turn turn_;
  float lift_ = 0;          // added to z in the level frame, metres
  Buffer<float> levelled_;  // x, y, z of each point
};

/// Coordinates are clamped to this, metres, so that products of finite numbers stay finite. It is
/// far beyond the range of any method.
constexpr float farthest = 1e12f;

/// x of a point that would be transformed to (0, 0, 0), metres. All zero means a missing return.
constexpr float next_to_sensor = 1e-6f;

/// Transforms one point. The code has no branches, so that the compiler can vectorise it.
struct ToLevel {
  Turn turn;
  Vector3f origin;  // subtracted before the rotation
  float scale;
  float lift;

  void operator()(const Point& p, float* to) const noexcept {
    const bool is_zero = (p.x == 0) & (p.y == 0) & (p.z == 0);
    // 0 for finite numbers, otherwise NaN. Keeps the NaN that clamp could lose.
    const float trouble = (p.x - p.x) + (p.y - p.y) + (p.z - p.z);
    const float x = std::clamp(p.x * scale, -farthest, farthest) - origin[0];
    const float y = std::clamp(p.y * scale, -farthest, farthest) - origin[1];
    const float z = std::clamp(p.z * scale, -farthest, farthest) - origin[2];
    const float level_x = turn.x[0] * x + turn.x[1] * y + turn.x[2] * z;
    const float level_y = turn.y[0] * x + turn.y[1] * y + turn.y[2] * z;
    const float level_z = turn.z[0] * x + turn.z[1] * y + turn.z[2] * z + lift;
    const bool would_be_zero = (level_x == 0) & (level_y == 0) & (level_z == 0);
    to[0] = is_zero ? 0 : (would_be_zero ? next_to_sensor : level_x) + trouble;
    to[1] = is_zero ? 0 : level_y;
    to[2] = is_zero ? 0 : level_z;
  }
};

namespace {

/// Transforms records of `floats` floats; the number is known at compile time.
template <std::size_t floats>
void level_packed(const float* from, std::size_t count, const ToLevel& to_level,
                  float* to) noexcept {
  for (std::size_t i = 0; i < count; ++i) {
    to_level({from[floats * i], from[floats * i + 1], from[floats * i + 2]}, to + 3 * i);
  }
}

/// Number of floats per point if the points are records of aligned floats that begin with x, y and
/// z; otherwise 0.
std::ptrdiff_t floats_a_point(CloudView cloud) noexcept {
  constexpr std::ptrdiff_t size = sizeof(float);
  const CloudLayout& layout = cloud.layout();
  const bool is_packed = layout.x == 0 && layout.y == size && layout.z == 2 * size &&
                         layout.stride % size == 0 &&
                         reinterpret_cast<std::uintptr_t>(cloud.data()) % alignof(float) == 0;
  return is_packed ? layout.stride / size : 0;
}

}  // namespace

void GravityAlignment::set(const Mount& mount) noexcept {
  mount_ = mount;
  turn_ = turn_to_z(mount.up);
  lift_ = mount.sensor_height - method_height_;
  const Vector3f none = {0, 0, 0};
  const Vector3f z = {0, 0, 1};
  is_identity_ = mount.up == z && mount.origin == none && mount.scale == 1 && lift_ == 0;
}

CloudView GravityAlignment::apply(CloudView cloud) {
  const ScopedFloatingPointMode same_everywhere;
  levelled_.reserve(3 * cloud.size());
  float* const to = levelled_.data();
  const ToLevel to_level = {turn_, mount_.origin, mount_.scale, lift_};
  const auto* const from = static_cast<const float*>(cloud.data());
  switch (floats_a_point(cloud)) {
    case 3: level_packed<3>(from, cloud.size(), to_level, to); break;
    case 4: level_packed<4>(from, cloud.size(), to_level, to); break;
    case 5: level_packed<5>(from, cloud.size(), to_level, to); break;
    default:
      for (std::size_t i = 0; i < cloud.size(); ++i) to_level(cloud[i], to + 3 * i);
  }
  return {to, cloud.size()};
}

void GravityAlignment::bring_back(Segmentation& result) const noexcept {
  for (Patch& patch : result.mutable_patches()) {
    const bool has_plane = patch.normal != Vector3f{0, 0, 0};
    if (!has_plane) continue;
    const Vector3f lowered = {patch.mean[0], patch.mean[1], patch.mean[2] - lift_};
    const Vector3f from_sensor = turn_.undo(lowered);
    for (std::size_t i = 0; i < 3; ++i) {
      patch.mean[i] = (from_sensor[i] + mount_.origin[i]) / mount_.scale;
    }
    // n . p + d = 0 with p = turn(scale * q - origin) + lift: divided by the scale.
    const float d = patch.d + patch.normal[2] * lift_;
    patch.normal = turn_.undo(patch.normal);
    patch.d = (d - dot(patch.normal, mount_.origin)) / mount_.scale;
  }
  if (lift_ == 0 || result.surface().empty()) return;
  for (GroundSurface::Grid& grid : result.mutable_surface().start()) {
    for (float& height : grid.heights) height -= lift_;
  }
}

}  // namespace flagstone::mount

namespace flagstone {

using mount::GravityAlignment;
using mount::MountTrack;

/// Estimates the mounting pose, transforms the cloud, runs the method and transforms the results
/// back.
struct GravityAlignedSegmenter::Impl {
  Impl(std::unique_ptr<Segmenter> inner, float method_height, const MountSettings& given)
      : settings(given),
        method(std::move(inner)),
        track(mount::expected_mount(settings), settings.height != HeightSource::fixed,
              settings.tilt == TiltSource::estimate, settings.tracking),
        alignment(method_height) {
    if (method == nullptr) throw std::invalid_argument("mount: the method is null");
    settings.check();
    check_number("mount", "method_height", method_height, {.low = -100, .high = 100, .unit = "m"});
    if (settings.estimates()) estimator.emplace(settings);
    reset();
  }

  void reset() noexcept {
    track.reset();
    decision = {};
    decision.mount = track.mount();
    decision.tilt = mount::degrees_between(decision.mount.up, {0, 0, 1});
    alignment.set(track.mount());
  }

  /// Estimates the mounting pose from the scan if the settings require it.
  void decide(CloudView cloud) noexcept {
    if (estimator && (settings.tracks() || !track.is_told())) {
      decision = estimator->estimate(cloud);
      track.take(decision);
      alignment.set(track.mount());
    } else if (estimator) {
      decision = {};
      decision.mount = track.mount();
      decision.tilt = mount::degrees_between(decision.mount.up, {0, 0, 1});
    }
  }

  MountSettings settings;
  std::unique_ptr<Segmenter> method;
  std::optional<MountEstimator> estimator;  // only if the settings require estimates
  MountTrack track;
  GravityAlignment alignment;
  MountDecision decision;
};

GravityAlignedSegmenter::GravityAlignedSegmenter(std::unique_ptr<Segmenter> method,
                                                 float method_height, const MountSettings& settings)
    : impl_(std::make_unique<Impl>(std::move(method), method_height, settings)) {}
GravityAlignedSegmenter::~GravityAlignedSegmenter() = default;
GravityAlignedSegmenter::GravityAlignedSegmenter(GravityAlignedSegmenter&&) noexcept = default;
GravityAlignedSegmenter& GravityAlignedSegmenter::operator=(GravityAlignedSegmenter&&) noexcept =
    default;

Status GravityAlignedSegmenter::segment(CloudView cloud, Segmentation& result) noexcept {
  Impl& w = *impl_;
  const bool is_readable = cloud.data() != nullptr || cloud.empty();
  const bool is_possible = is_readable && cloud.size() <= std::numeric_limits<std::uint32_t>::max();
  if (!is_possible) return w.method->segment(cloud, result);  // returns the error
  w.decide(cloud);
  if (w.alignment.is_identity()) return w.method->segment(cloud, result);
  CloudView level;
  try {
    level = w.alignment.apply(cloud);
  } catch (const std::bad_alloc&) {
    result.clear();
    return Status(StatusCode::out_of_memory);
  }
  Status status = w.method->segment(level, result);
  if (status.ok()) w.alignment.bring_back(result);
  return status;
}

const Mount& GravityAlignedSegmenter::mount() const noexcept { return impl_->track.mount(); }
const MountDecision& GravityAlignedSegmenter::decision() const noexcept { return impl_->decision; }
void GravityAlignedSegmenter::reset() noexcept { impl_->reset(); }
const MountSettings& GravityAlignedSegmenter::settings() const noexcept { return impl_->settings; }

}  // namespace flagstone
