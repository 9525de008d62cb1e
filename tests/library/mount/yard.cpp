// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "library/mount/yard.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

#include "flagstone/sensor.hpp"
#include "lab/sim/scan.hpp"

namespace flagstone::tests {
namespace {

constexpr int half_width = 40;  // half the side of the ground, metres

sim::Ground ground_of(const Yard& yard) {
  sim::GroundGrid lines;
  for (int i = -half_width; i <= half_width; ++i) {
    lines.x.push_back(i);
    lines.offset.push_back(0);
    lines.t.push_back(i);
  }
  std::vector<double> heights;
  for (const double x : lines.x) {
    for (const double y : lines.t) heights.push_back(yard.ground(x, y));
  }
  const std::size_t cells = (lines.x.size() - 1) * (lines.t.size() - 1);
  const sim::Surface road{.semantic = sim::SemanticClass::road, .reflectivity = 0.2f};
  return {std::move(lines), std::move(heights), std::vector<sim::Surface>(cells, road)};
}

}  // namespace

YardScan scan_of(const Yard& yard) {
  sim::Mesh objects;
  const sim::Surface painted{.semantic = sim::SemanticClass::building, .reflectivity = 0.4f};
  for (const sim::Box& box : yard.boxes) add_box(objects, sim::Frame{}, box, painted);
  const sim::Scene scene(ground_of(yard), std::move(objects));
  const sim::Frame vehicle = sim::vehicle_pose(scene.ground(), 0, 0, 0);
  const sim::Frame pose = sim::sensor_pose(vehicle, yard.mounting);
  const sim::SimulatedScan scan =
      sim::simulate(scene, Sensor::named(yard.sensor), sim::Noise{}, pose, 1);

  YardScan result;
  result.mount.sensor_height = static_cast<float>(yard.mounting.height);
  result.mount.up = {static_cast<float>(dot(vehicle.up, pose.forward)),
                     static_cast<float>(dot(vehicle.up, pose.left)),
                     static_cast<float>(dot(vehicle.up, pose.up))};
  for (std::size_t i = 0; i < scan.size(); ++i) {
    result.points.push_back({scan.xyzi[4 * i], scan.xyzi[4 * i + 1], scan.xyzi[4 * i + 2]});
  }
  return result;
}

float degrees_between(const std::array<float, 3>& a, const std::array<float, 3>& b) {
  const double cosine = double{a[0]} * b[0] + double{a[1]} * b[1] + double{a[2]} * b[2];
  return static_cast<float>(std::acos(std::min(cosine, 1.0)) * 180 / std::numbers::pi);
}

std::vector<Point> level_ground(float height) {
  std::vector<Point> points;
  for (int ring = 0; ring < 20; ++ring) {
    const float range = 3 + 0.45f * static_cast<float>(ring);
    for (int i = 0; i < 250; ++i) {
      const float azimuth = static_cast<float>(i) * 0.0251327f;  // a 250th turn
      points.push_back({range * std::cos(azimuth), range * std::sin(azimuth), -height});
    }
  }
  return points;
}

}  // namespace flagstone::tests
