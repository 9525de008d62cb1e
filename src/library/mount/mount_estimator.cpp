// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <iomanip>
#include <memory>
#include <optional>
#include <span>
#include <sstream>
#include <string>

#include "flagstone/mount.hpp"
#include "library/core/floating_point_mode.hpp"
#include "library/core/segment_scan.hpp"
#include "library/mount/ground_plane.hpp"
#include "library/mount/mount_settings.hpp"
#include "library/mount/near_points.hpp"
#include "library/mount/vectors.hpp"

namespace flagstone {

using mount::Agreement;
using mount::AgreementCount;
using mount::degrees_between;
using mount::GroundPlane;
using mount::NearPoint;
using mount::NearPoints;
using mount::PlaneSearch;
using mount::Turn;
using mount::turn_to_z;

namespace {

/// Minimum number of points for an estimate.
constexpr std::size_t fewest_points = 40;

/// Numbers of directions, of sixteen: with at least `all_round` of them, ground surrounds the
/// sensor; with at most `narrow`, it is on one side.
constexpr int all_round = 8;
constexpr int narrow = 4;

/// If the mean range of the ground exceeds this fraction of the reach, the ground does not show its
/// height below the sensor. The estimate is then repeated within `farther` times the reach.
constexpr float far_share = 0.52f;
constexpr float farther = 2.5f;

/// Cost of a tilt in the distant pass: walls and rows of cars can form tilted planes, so that more
/// evidence is required.
constexpr float lean_cost_afar = 45;

}  // namespace

/// Finds points near the vehicle, fits a plane to them and evaluates it.
struct MountEstimator::Impl {
  explicit Impl(const MountSettings& given)
      : settings(checked(given)),
        looks_for_tilt(settings.tilt == TiltSource::estimate),
        expected(mount::expected_mount(settings)),
        level(turn_to_z(expected.up)),
        near(settings.limits, looks_for_tilt),
        search(settings.limits, looks_for_tilt) {}

  MountDecision estimate(CloudView cloud) noexcept;
  MountDecision look(CloudView cloud, float reach, float lean_cost) noexcept;
  void take_plane(const GroundPlane& plane, const Agreement& agreed,
                  MountDecision& decision) const noexcept;
  [[nodiscard]] std::optional<MountVerdict> beyond_limits(const Mount& mount) const noexcept;

  MountSettings settings;
  bool looks_for_tilt;
  Mount expected;
  Turn level;  // from the frame of the cloud to a frame with the expected up direction along z
  NearPoints near;
  PlaneSearch search;
  AgreementCount agreement;
  float ground_range =
      0;  // mean range of the ground in the last pass, metres; its reach if it found none
};

void MountEstimator::Impl::take_plane(const GroundPlane& plane, const Agreement& agreed,
                                      MountDecision& decision) const noexcept {
  const auto [x, y, z] = plane.up;
  if (looks_for_tilt) {
    decision.mount.up = mount::unit(level.undo(plane.up));
    decision.mount.sensor_height = plane.height;
  } else {
    // The height is measured straight down from the sensor. If ground is seen on one side only, it
    // is measured there, because its slope may belong to the ground or to a tilted sensor.
    const float off = static_cast<float>(all_round - agreed.directions) / (all_round - narrow);
    const float to_seen = std::clamp(off, 0.0f, 1.0f);
    decision.mount.sensor_height = (plane.height + to_seen * (x * agreed.x + y * agreed.y)) / z;
  }
  decision.tilt = degrees_between(decision.mount.up, {0, 0, 1});
}

std::optional<MountVerdict> MountEstimator::Impl::beyond_limits(const Mount& mount) const noexcept {
  const MountLimits& limits = settings.limits;
  if (degrees_between(mount.up, expected.up) > limits.max_tilt) return MountVerdict::tilt_limit;
  const bool is_within =
      mount.sensor_height >= limits.min_height && mount.sensor_height <= limits.max_height;
  if (!is_within) return MountVerdict::height_limit;
  return {};
}

MountDecision MountEstimator::Impl::look(CloudView cloud, float reach, float lean_cost) noexcept {
  MountDecision decision;
  decision.mount = expected;
  decision.tilt = degrees_between(expected.up, {0, 0, 1});
  decision.verdict = MountVerdict::too_few_points;
  ground_range = reach;
  const std::span<const NearPoint> points = near.find(cloud, expected, level, reach);
  decision.points = static_cast<std::uint32_t>(points.size());
  if (points.size() < fewest_points) return decision;

  decision.verdict = MountVerdict::no_plane;
  const std::optional<GroundPlane> plane = search.find(points, lean_cost);
  if (!plane) return decision;
  const Agreement agreed = agreement.of(points, *plane, reach);
  ground_range = agreed.range;
  take_plane(*plane, agreed, decision);
  decision.cells = agreed.cells;
  decision.free = agreed.free;
  decision.below = agreed.below;
  decision.spread = agreed.spread;
  decision.directions = agreed.directions;
  decision.seen = agreed.seen;
  mount::judge(decision, settings.limits.min_confidence);
  if (const auto beyond = beyond_limits(decision.mount)) {
    decision.verdict = *beyond;
    decision.confidence = 0;
  }
  return decision;
}

MountDecision MountEstimator::Impl::estimate(CloudView cloud) noexcept {
  const ScopedFloatingPointMode same_everywhere;
  if (cloud.data() == nullptr) cloud = {};
  const float reach = settings.limits.reach;
  const auto begins_afar = [&] { return ground_range > far_share * reach; };
  MountDecision near_by = look(cloud, reach, lean_cost_afar);
  if (looks_for_tilt && !begins_afar()) near_by = look(cloud, reach, 0);
  return begins_afar() ? look(cloud, farther * reach, lean_cost_afar) : near_by;
}

MountEstimator::MountEstimator(const MountSettings& settings)
    : impl_(std::make_unique<Impl>(settings)) {}
MountEstimator::~MountEstimator() = default;
MountEstimator::MountEstimator(MountEstimator&&) noexcept = default;
MountEstimator& MountEstimator::operator=(MountEstimator&&) noexcept = default;

MountDecision MountEstimator::estimate(CloudView cloud) noexcept { return impl_->estimate(cloud); }

const MountSettings& MountEstimator::settings() const noexcept { return impl_->settings; }

namespace {

void add_mount(std::ostream& text, const MountDecision& decision) {
  text << "sensor " << decision.mount.sensor_height << " m above the ground";
  if (decision.tilt >= 0.05f) {
    const auto& up = decision.mount.up;
    text << ", tilted by " << std::setprecision(1) << decision.tilt << " degrees"
         << std::setprecision(3) << ", up is (" << up[0] << ", " << up[1] << ", " << up[2] << ')'
         << std::setprecision(2);
  }
}

void add_reason(std::ostream& text, const MountDecision& decision) {
  const auto percent = [&](float share) {
    text << std::setprecision(0) << 100 * share << " %" << std::setprecision(2);
  };
  switch (decision.verdict) {
    case MountVerdict::fixed:
    case MountVerdict::accepted: break;
    case MountVerdict::too_few_points:
      text << "too few points where ground can be: " << decision.points << " cubes with points, "
           << decision.cells << " cells with ground";
      break;
    case MountVerdict::no_plane:
      text << "near points do not fit one plane, RMS distance " << decision.spread << " m";
      break;
    case MountVerdict::obstructed:
      text << "the lowest points are at the base of objects, only ";
      percent(decision.free);
      text << " of the ground cells are unobstructed";
      break;
    case MountVerdict::points_below:
      text << "too many points below the best plane, in ";
      percent(decision.below);
      text << " of the cells";
      break;
    case MountVerdict::one_sided:
      text << "ground is visible in only " << decision.directions << " of the " << decision.seen
           << " directions with points";
      break;
    case MountVerdict::height_limit: text << "the height is outside the limits"; break;
    case MountVerdict::tilt_limit: text << "the tilt exceeds the limit"; break;
    case MountVerdict::outlier: text << "too far from the estimates of previous scans"; break;
  }
}

}  // namespace

std::string to_sentence(const MountDecision& decision) {
  std::ostringstream text;
  text << std::fixed << std::setprecision(2);
  if (decision.verdict == MountVerdict::fixed) {
    add_mount(text, decision);
    text << ", as configured";
  } else if (decision.accepted()) {
    add_mount(text, decision);
    text << ", confidence " << decision.confidence;
  } else {
    text << "no estimate from this scan: ";
    add_reason(text, decision);
    const bool has_plane = decision.cells > 0;
    if (has_plane) {
      text << " (rejected estimate: ";
      add_mount(text, decision);
      text << ", confidence " << decision.confidence << ')';
    }
  }
  return text.str();
}

}  // namespace flagstone
