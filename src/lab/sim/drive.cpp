// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/sim/drive.hpp"

#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <utility>

#include "flagstone/sensor.hpp"
#include "lab/sim/ground.hpp"
#include "lab/sim/noise.hpp"
#include "lab/sim/street.hpp"

namespace flagstone::sim {

Frame vehicle_pose(const Ground& ground, double x, double y, double yaw) {
  constexpr double wheelbase = 2.7;  // of the KITTI car, metres
  constexpr double track = 1.6;
  return frame_on_wheels(ground, x, y, yaw, wheelbase, track);
}

Frame sensor_pose(const Frame& vehicle, const Mounting& mounting) {
  constexpr double radians = std::numbers::pi / 180;
  Frame pose = raised(vehicle, mounting.height);
  const double pitch = mounting.pitch * radians;
  const Vector3 up = std::sin(pitch) * pose.forward + std::cos(pitch) * pose.up;
  pose.forward = std::cos(pitch) * pose.forward - std::sin(pitch) * pose.up;
  const double roll = mounting.roll * radians;
  pose.up = std::cos(roll) * up - std::sin(roll) * pose.left;
  pose.left = std::cos(roll) * pose.left + std::sin(roll) * up;
  return pose;
}

Frame sensor_pose(const Ground& ground, const Sensor& sensor, double x, double y, double yaw) {
  return sensor_pose(vehicle_pose(ground, x, y, yaw), {.height = sensor.height});
}

std::uint64_t drive_seed(std::uint64_t sequence_seed, std::uint64_t index) noexcept {
  return Random::stream(sequence_seed, index).bits();
}

std::size_t Pace::frames() const noexcept {
  constexpr double rounding = 1e-9;
  return 1 + static_cast<std::size_t>((frames_per_drive - 1) / stops_per_frame() + rounding);
}

Drive::Drive(const SceneKind& kind, Sensor sensor, const Mounting& mounting, std::uint64_t seed,
             const Pace& pace)
    : sensor_(std::move(sensor)), seed_(seed), pace_(pace), landscape_(kind.make(seed)) {
  for (std::size_t frame = 0; frame < pace.frames(); ++frame) {
    const Stop stop =
        between_stops(landscape_.route, static_cast<double>(frame) * pace.stops_per_frame());
    const Frame vehicle = vehicle_pose(landscape_.ground, stop.x, stop.y, stop.yaw);
    poses_.push_back(sensor_pose(vehicle, mounting));
    upward_.push_back(vehicle.up);
  }
}

Scene Drive::scene() const { return {landscape_.ground, landscape_.furnish(landscape_.ground)}; }

SimulatedScan Drive::scan(const Scene& scene, const Noise& noise, int frame,
                          bool keep_no_returns) const {
  const auto index = static_cast<std::size_t>(frame);
  // Stream 0 of the seed is used for the scene.
  const std::uint64_t noise_seed = Random::stream(seed_, index + 1).bits();
  std::optional<RayCaster> moving;
  if (landscape_.moving) {
    const double seconds = frame * pace_.stops_per_frame() * stop_interval;
    moving.emplace(landscape_.moving(landscape_.ground, seconds));
  }
  return simulate(
      scene, sensor_, noise, poses_[index], noise_seed,
      {.number = frame, .moving = moving ? &*moving : nullptr, .keep_no_returns = keep_no_returns});
}

std::vector<float> Drive::ground_of(const SimulatedScan& scan, int frame) const {
  const auto index = static_cast<std::size_t>(frame);
  return true_ground(landscape_.ground, poses_[index], upward_[index], scan.xyzi);
}

namespace {

/// Pose of the sensor in a street.
Frame pose_in(const Scene& street, const Sensor& sensor) {
  constexpr double right_lane = -1.6;  // metres left of the centre line
  return sensor_pose(street.ground(), sensor, 0, right_lane, 0);
}

}  // namespace

SimulatedScan simulate_street(std::uint64_t seed, unsigned threads) {
  const Scene street = make_street(seed);
  const Sensor& sensor = Sensor::named("hdl-64e");
  return simulate(street, sensor, Noise{}, pose_in(street, sensor), seed, {.threads = threads});
}

std::vector<float> street_ground(std::uint64_t seed, std::span<const float> xyzi) {
  const Scene street = make_street(seed);
  return true_ground(street.ground(), pose_in(street, Sensor::named("hdl-64e")), xyzi);
}

}  // namespace flagstone::sim
