// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "app/doctor/frame_orientation.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "flagstone/cloud_view.hpp"

namespace flagstone::doctor {
namespace {

using mount::dot;

constexpr std::array<Vector3f, 6> frame_axes{
    {{0, 0, 1}, {0, 0, -1}, {0, 1, 0}, {0, -1, 0}, {1, 0, 0}, {-1, 0, 0}}};

/// Axes other than z must score higher by this factor.
constexpr float bonus_of_z = 1.3f;

MountDecision estimate_for(std::span<const Vector3f> places, double metres, const Vector3f& axis,
                           float height, TiltSource tilt) {
  MountSettings settings;
  settings.tilt = tilt;
  settings.mount.up = axis;
  settings.mount.scale = static_cast<float>(metres);
  for (std::size_t i = 0; i < 3; ++i) settings.mount.origin[i] = height * axis[i];
  MountEstimator estimator(settings);
  return estimator.estimate({places.data()->data(), places.size()});
}

/// The estimate for a sensor at `height` along `axis`, which is roughly up.
FrameOrientation orientation_for(std::span<const Vector3f> places, double metres,
                                 const Vector3f& axis, float height) {
  return {.axis = axis,
          .decision = estimate_for(places, metres, axis, height, TiltSource::estimate),
          .seen_from = height};
}

FrameOrientation with_level(std::span<const Vector3f> places, double metres,
                            FrameOrientation orientation) {
  orientation.level =
      estimate_for(places, metres, orientation.axis, orientation.seen_from, TiltSource::fixed);
  return orientation;
}

/// Fraction of the points off the ground that are above it. Objects on the ground are above it;
/// ground that slopes down is below it.
float fraction_above(std::span<const Vector3f> places, double metres,
                     const FrameOrientation& orientation) {
  const Mount& mount = orientation.decision.mount;
  const float ground = dot(mount.origin, mount.up) - mount.sensor_height;
  constexpr float at_ground = 0.5f;
  float above = 0;
  float below = 0;
  for (const Vector3f& place : places) {
    const float height = dot(place, mount.up) * static_cast<float>(metres) - ground;
    if (height > at_ground) ++above;
    if (height < -at_ground) ++below;
  }
  return above / std::max(above + below, 1.0f);
}

float score_of(std::span<const Vector3f> places, double metres,
               const FrameOrientation& orientation) {
  if (!orientation.is_found()) return 0;
  const float bonus = orientation.axis == frame_axes[0] ? bonus_of_z : 1;
  constexpr float least_above = 0.25f;
  const float above = fraction_above(places, metres, orientation);
  return above < least_above ? 0 : bonus * orientation.decision.confidence * above;
}

/// Height along `axis` with the most points near the origin, metres; the lowest of similar peaks.
/// Nothing if there are fewer than 100 points at that height.
std::optional<float> strongest_level(std::span<const Vector3f> places, double metres,
                                     const Vector3f& axis) {
  constexpr float radius = 20;
  constexpr float step = 0.2f;
  constexpr std::size_t steps = 2000;
  constexpr float lowest = -step * steps / 2;
  std::vector<std::size_t> counts(steps);
  for (const Vector3f& place : places) {
    const float height = dot(place, axis) * static_cast<float>(metres);
    const float square = dot(place, place) * static_cast<float>(metres * metres);
    const float level = (height - lowest) / step;
    const bool is_near = square - height * height < radius * radius;
    if (is_near && level >= 0 && level < steps) ++counts[static_cast<std::size_t>(level)];
  }
  const std::size_t most = *std::ranges::max_element(counts);
  if (most < 100) return {};
  const auto found = std::ranges::find_if(counts, [&](std::size_t n) { return 2 * n > most; });
  return lowest + step * (static_cast<float>(found - counts.begin()) + 0.5f);
}

void take_if_better(const FrameOrientation& candidate, std::span<const Vector3f> places,
                    double metres, FrameOrientation& best) {
  if (score_of(places, metres, candidate) > score_of(places, metres, best)) best = candidate;
}

}  // namespace

float FrameOrientation::ground_of_tilt() const noexcept {
  return seen_from - decision.mount.sensor_height / dot(decision.mount.up, axis);
}

float FrameOrientation::ground_of_axis() const noexcept {
  return level.accepted() ? seen_from - level.mount.sensor_height : ground_of_tilt();
}

double FrameOrientation::tilt() const noexcept {
  const double cosine = std::clamp(double{dot(decision.mount.up, axis)}, -1.0, 1.0);
  return std::acos(cosine) * 180 / std::numbers::pi;
}

FrameOrientation find_orientation(std::span<const Vector3f> places, double metres) {
  const FrameOrientation usual = orientation_for(places, metres, frame_axes[0], 0);
  FrameOrientation best = usual;
  for (const Vector3f& axis : std::span(frame_axes).subspan(1)) {
    take_if_better(orientation_for(places, metres, axis, 0), places, metres, best);
  }
  if (score_of(places, metres, best) > 0) return with_level(places, metres, best);
  constexpr float usual_height = 1.8f;
  for (const Vector3f& axis : frame_axes) {
    const std::optional<float> level = strongest_level(places, metres, axis);
    if (!level) continue;
    take_if_better(orientation_for(places, metres, axis, *level + usual_height), places, metres,
                   best);
  }
  if (score_of(places, metres, best) > 0) return with_level(places, metres, best);
  // A plane with most points below it is a ceiling, or the ground upside down.
  best = usual;
  if (best.is_found()) best.decision.verdict = MountVerdict::points_below;
  return best;
}

}  // namespace flagstone::doctor
