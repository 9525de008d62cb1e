// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "clouds.hpp"

#include <cmath>
#include <thread>
#include <utility>

#include "flagstone/sensor.hpp"
#include "lab/sim/drive.hpp"
#include "lab/sim/noise.hpp"
#include "lab/sim/scan.hpp"
#include "lab/sim/street.hpp"

namespace flagstone::performance {
namespace {

Point rotated(const Point& p, float cosine, float sine) {
  return {cosine * p.x - sine * p.y, sine * p.x + cosine * p.y, p.z};
}

}  // namespace

Cloud simulated_street(int beams, int columns, std::uint64_t seed) {
  constexpr double top = 2;
  constexpr double bottom = -24.8;
  constexpr double right_lane = -1.6;  // metres left of the centre line
  Sensor sensor = Sensor::named("hdl-64e");
  sensor.firings = columns;
  sensor.elevations.clear();
  for (int beam = 0; beam < beams; ++beam) {
    sensor.elevations.push_back(top + (bottom - top) * beam / (beams - 1));
  }
  const sim::Scene street = sim::make_street(seed);
  const sim::Frame pose = sim::sensor_pose(street.ground(), sensor, 0, right_lane, 0);
  const sim::SimulatedScan scan = sim::simulate(street, sensor, sim::Noise{}, pose, seed,
                                                {.threads = std::thread::hardware_concurrency()});
  Cloud cloud;
  cloud.reserve(scan.size());
  for (std::size_t i = 0; i < scan.size(); ++i) {
    cloud.push_back({scan.xyzi[4 * i], scan.xyzi[4 * i + 1], scan.xyzi[4 * i + 2]});
  }
  return cloud;
}

Cloud resized(const Cloud& cloud, std::size_t count) {
  Cloud result;
  result.reserve(count);
  if (count <= cloud.size()) {
    for (std::size_t i = 0; i < count; ++i) result.push_back(cloud[i * cloud.size() / count]);
    return result;
  }
  for (double angle = 0; result.size() < count; angle += 1) {
    const auto cosine = static_cast<float>(std::cos(angle));
    const auto sine = static_cast<float>(std::sin(angle));
    for (std::size_t i = 0; i < cloud.size() && result.size() < count; ++i) {
      result.push_back(rotated(cloud[i], cosine, sine));
    }
  }
  return result;
}

Cloud rotated(Cloud cloud, double angle) {
  const auto cosine = static_cast<float>(std::cos(angle));
  const auto sine = static_cast<float>(std::sin(angle));
  for (Point& p : cloud) p = rotated(p, cosine, sine);
  return cloud;
}

Cloud shuffled(Cloud cloud, Random& random) {
  for (std::size_t left = cloud.size(); left > 1; --left) {
    std::swap(cloud[left - 1], cloud[random.bits() % left]);
  }
  return cloud;
}

}  // namespace flagstone::performance
