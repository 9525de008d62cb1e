// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/sim/pose_noise.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "library/core/random.hpp"

namespace flagstone::sim {
namespace {

constexpr double radians = std::numbers::pi / 180;

constexpr std::array kinds = {
    PoseNoise{.name = "none", .summary = "exact poses only"},
    PoseNoise{.name = "jitter",
              .summary = "each pose is off by 2 cm and 0.2 degrees (standard deviations)",
              .position_sigma = 0.02,
              .angle_sigma = 0.2},
    PoseNoise{.name = "drift",
              .summary = "errors grow by 1 % of the distance and 1 degree of yaw per 100 m",
              .scale_drift = 0.01,
              .yaw_drift = 0.01},
};

// `vector` turned about `axis`, which has length 1 (Rodrigues' formula).
Vector3 turned(Vector3 vector, Vector3 axis, double angle) {
  return std::cos(angle) * vector + std::sin(angle) * cross(axis, vector) +
         (1 - std::cos(angle)) * dot(axis, vector) * axis;
}

Frame turned(const Frame& frame, Vector3 axis, double angle) {
  return {.origin = frame.origin,
          .forward = turned(frame.forward, axis, angle),
          .left = turned(frame.left, axis, angle),
          .up = turned(frame.up, axis, angle)};
}

Frame with_jitter(Frame pose, const PoseNoise& noise, Random random) {
  const double sigma = noise.position_sigma;
  pose.origin = pose.origin +
                Vector3{sigma * random.normal(), sigma * random.normal(), sigma * random.normal()};
  const double angle = noise.angle_sigma * radians;
  pose = turned(pose, pose.up, angle * random.normal());
  pose = turned(pose, pose.left, angle * random.normal());
  return turned(pose, pose.forward, angle * random.normal());
}

// Adds up the motions between the exact poses, each with its error.
std::vector<Frame> with_drift(std::span<const Frame> exact, const PoseNoise& noise, Random random) {
  constexpr Vector3 upright{0, 0, 1};
  const auto sign = [&random] { return random.chance(0.5) ? 1.0 : -1.0; };
  const double scale = 1 + sign() * noise.scale_drift;
  const double climb = sign() * noise.scale_drift;
  const double yaw_per_metre = sign() * noise.yaw_drift * radians;
  std::vector<Frame> poses;
  double way = 0;
  for (std::size_t i = 0; i < exact.size(); ++i) {
    Frame pose = exact[i];
    if (i > 0) {
      const Vector3 motion = exact[i].origin - exact[i - 1].origin;
      const double step = length(motion);
      way += step;
      pose = turned(pose, upright, yaw_per_metre * way);
      pose.origin = poses.back().origin + scale * turned(motion, upright, yaw_per_metre * way) +
                    climb * step * upright;
    }
    poses.push_back(pose);
  }
  return poses;
}

}  // namespace

std::span<const PoseNoise> pose_noises() noexcept { return kinds; }

const PoseNoise* find_pose_noise(std::string_view name) noexcept {
  const auto* const found = std::ranges::find(kinds, name, &PoseNoise::name);
  return found == kinds.end() ? nullptr : &*found;
}

std::vector<Frame> measured_poses(std::span<const Frame> exact, const PoseNoise& noise,
                                  std::uint64_t seed) {
  std::vector<Frame> poses = with_drift(exact, noise, Random::stream(~seed, 0));
  for (std::size_t i = 0; i < poses.size(); ++i) {
    poses[i] = with_jitter(poses[i], noise, Random::stream(~seed, i + 1));
  }
  return poses;
}

}  // namespace flagstone::sim
