// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/sim/drive.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
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

std::size_t Pace::frames(const Extent& extent) const noexcept {
  constexpr double rounding = 1e-9;
  const auto stops = static_cast<double>(extent.stretches_of_run() * stops_per_stretch);
  return 1 + static_cast<std::size_t>(stops / stops_per_frame() + rounding);
}

namespace {

// A scan needs this many stretches before and behind the one of the sensor.
constexpr std::size_t stretches_in_view = 3;

Landscape make(const SceneKind& kind, std::uint64_t seed, const Extent& extent) {
  return extent.is_long() ? kind.make_long(seed, extent) : kind.make(seed);
}

}  // namespace

Drive::Drive(const SceneKind& kind, Sensor sensor, const Mounting& mounting, std::uint64_t seed,
             const Pace& pace, const Extent& extent)
    : sensor_(std::move(sensor)),
      mounting_(mounting),
      seed_(seed),
      pace_(pace),
      extent_(extent),
      landscape_(make(kind, seed, extent)) {
  // Stream 0 of the seed is used for the scene, those of ~seed for the noise of the poses.
  if (extent.is_long()) alignment_.emplace(extent, Random::stream(~seed, ~std::uint64_t{0}));
  ground_ = std::make_shared<const Ground>(alignment_ ? landscape_.ground.along(*alignment_)
                                                      : landscape_.ground);
  for (std::size_t frame = 0; frame < pace.frames(extent); ++frame) {
    const Pose pose = at(static_cast<double>(frame));
    poses_.push_back(pose.sensor);
    upward_.push_back(pose.up);
  }
}

Drive::Pose Drive::at(double scans) const {
  Stop stop = between_stops(landscape_.route, scans * pace_.stops_per_frame());
  if (alignment_) stop = alignment_->to_world(stop);
  const Frame vehicle = vehicle_pose(*ground_, stop.x, stop.y, stop.yaw);
  return {.sensor = sensor_pose(vehicle, mounting_), .up = vehicle.up};
}

Drive::Parts Drive::parts_of(std::size_t frame, const Pace& pace, const Extent& extent) noexcept {
  const double stops = static_cast<double>(frame) * pace.stops_per_frame();
  const std::size_t at = extent.stretch_at(extent.begin() + stops * frame_spacing);
  if (extent.closed) return {.first = at, .count = 2 * stretches_in_view + 1};
  const std::size_t first = at - std::min(at, stretches_in_view);
  const std::size_t last = std::min(at + stretches_in_view, extent.stretches - 1);
  return {.first = first, .count = last - first + 1};
}

std::size_t Drive::part_count(const Extent& extent) noexcept {
  return extent.stretches_of_run() + (extent.closed ? 2 * stretches_in_view : 0);
}

std::shared_ptr<const RayCaster> Drive::part(std::size_t number) const {
  // On a circuit, part 0 is the first one in view behind the first stretch.
  const std::size_t before = extent_.closed ? extent_.stretches - stretches_in_view : 0;
  const Stretch stretch = extent_.stretch((number + before) % extent_.stretches);
  Mesh mesh = in_world(landscape_.furnish(landscape_.ground, stretch));
  constexpr double beyond = std::numeric_limits<double>::infinity();
  ground_->add_to(mesh, stretch.reach(beyond));
  return std::make_shared<const RayCaster>(std::move(mesh));
}

Scene Drive::scene(std::size_t frame) const {
  const Parts needed = parts_of(frame, pace_, extent_);
  std::vector<std::shared_ptr<const RayCaster>> parts;
  parts.reserve(needed.count);
  for (std::size_t i = 0; i < needed.count; ++i) parts.push_back(part(needed.first + i));
  return scene(std::move(parts));
}

Mesh Drive::in_world(Mesh mesh) const {
  if (alignment_) mesh.move([this](Vector3 road) { return alignment_->to_world(road); });
  return mesh;
}

RayCaster Drive::moving_at(double scans) const {
  const double seconds = scans * pace_.stops_per_frame() * stop_interval;
  return RayCaster(in_world(landscape_.moving(landscape_.ground, seconds)));
}

// The time of a firing after the first one of its scan, in scans.
double Drive::time_of(std::uint32_t firing) const noexcept {
  return pace_.distortion ? static_cast<double>(firing) / sensor_.firings : 0;
}

SimulatedScan Drive::scan(const Scene& scene, const Noise& noise, int frame,
                          bool keep_no_returns) const {
  const auto index = static_cast<std::size_t>(frame);
  // Stream 0 of the seed is used for the scene.
  const std::uint64_t noise_seed = Random::stream(seed_, index + 1).bits();
  // With motion distortion, moving objects jump this often in a scan; the sensor moves steadily.
  constexpr std::uint32_t jumps = 16;
  const std::uint32_t slices = pace_.distortion ? jumps : 1;
  std::vector<RayCaster> moving;
  for (std::uint32_t slice = 0; landscape_.moving && slice < slices; ++slice) {
    const double middle = pace_.distortion ? (slice + 0.5) / slices : 0;
    moving.push_back(moving_at(frame + middle));
  }
  std::vector<Firing> firings;
  const auto count = pace_.distortion ? static_cast<std::uint32_t>(sensor_.firings) : 1U;
  firings.reserve(count);
  for (std::uint32_t firing = 0; firing < count; ++firing) {
    firings.push_back({.pose = pace_.distortion ? pose_at(frame + time_of(firing)) : poses_[index],
                       .moving = moving.empty() ? nullptr : &moving[firing * slices / count]});
  }
  return simulate(scene, sensor_, noise, firings, noise_seed,
                  {.number = frame, .keep_no_returns = keep_no_returns});
}

std::vector<float> Drive::ground_of(const SimulatedScan& scan, int frame) const {
  const auto index = static_cast<std::size_t>(frame);
  if (!pace_.distortion) return true_ground(*ground_, poses_[index], upward_[index], scan.xyzi);
  std::vector<Pose> poses;
  const auto count = static_cast<std::uint32_t>(sensor_.firings);
  poses.reserve(count);
  for (std::uint32_t firing = 0; firing < count; ++firing) {
    poses.push_back(at(frame + time_of(firing)));
  }
  std::vector<float> heights;
  for (std::size_t i = 0; i < scan.size(); ++i) {
    const Pose& pose = poses[scan.firings[i]];
    heights.push_back(true_ground(*ground_, pose.sensor, pose.up, &scan.xyzi[4 * i]));
  }
  return heights;
}

std::vector<float> Drive::times_of(const SimulatedScan& scan) const {
  std::vector<float> times;
  times.reserve(scan.size());
  for (const std::uint32_t firing : scan.firings) {
    times.push_back(static_cast<float>(time_of(firing) / pace_.rate));
  }
  return times;
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
