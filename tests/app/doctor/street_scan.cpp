// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "app/doctor/street_scan.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>

#include "lab/sim/drive.hpp"
#include "lab/sim/mesh.hpp"
#include "library/core/random.hpp"

namespace flagstone::doctor {
namespace {

io::Cloud cloud_of_floats(const std::vector<float>& values, std::size_t floats_per_point) {
  io::Cloud cloud;
  EXPECT_TRUE(io::Cloud::from_floats(values, floats_per_point, cloud).ok());
  return cloud;
}

const sim::SimulatedScan& street() {
  static const sim::SimulatedScan scan = sim::simulate_street(7);
  return scan;
}

}  // namespace

const std::vector<Point>& street_scan() {
  static const std::vector<Point> points = [] {
    std::vector<Point> made;
    const std::vector<float>& xyzi = street().xyzi;
    for (std::size_t i = 0; i < xyzi.size(); i += 4) {
      made.push_back({xyzi[i], xyzi[i + 1], xyzi[i + 2]});
    }
    return made;
  }();
  return points;
}

const std::vector<Truth>& street_truth() {
  static const std::vector<Truth> truth = [] {
    std::vector<Truth> made;
    for (const std::uint32_t semantic : street().classes) {
      const bool is_ground = sim::is_ground(static_cast<sim::SemanticClass>(semantic));
      made.push_back(is_ground ? Truth::ground : Truth::not_ground);
    }
    return made;
  }();
  return truth;
}

io::Cloud cloud_of(const std::vector<Point>& points) {
  std::vector<float> values;
  for (const Point& p : points) values.insert(values.end(), {p.x, p.y, p.z});
  return cloud_of_floats(values, 3);
}

io::Cloud cloud_of(const std::vector<Point>& points, const std::vector<float>& rings) {
  std::vector<float> values;
  for (std::size_t i = 0; i < points.size(); ++i) {
    values.insert(values.end(), {points[i].x, points[i].y, points[i].z, 0, rings[i]});
  }
  return cloud_of_floats(values, 5);  // the reader names the fifth field `ring`
}

std::vector<Point> changed(std::vector<Point> points, const std::function<Point(Point)>& change) {
  for (Point& point : points) point = change(point);
  return points;
}

std::vector<Point> shuffled(std::vector<Point> points) {
  Random random(1);
  for (std::size_t i = points.size(); i > 1; --i) {
    std::swap(points[i - 1], points[random.bits() % i]);
  }
  return points;
}

std::vector<Point> voxel_means(const std::vector<Point>& points, float side) {
  struct Sum {
    double x = 0, y = 0, z = 0, count = 0;
  };
  std::map<std::array<float, 3>, Sum> voxels;
  for (const Point& p : points) {
    Sum& sum = voxels[{std::floor(p.x / side), std::floor(p.y / side), std::floor(p.z / side)}];
    sum = {sum.x + p.x, sum.y + p.y, sum.z + p.z, sum.count + 1};
  }
  std::vector<Point> means;
  means.reserve(voxels.size());
  for (const auto& [voxel, sum] : voxels) {
    means.push_back({static_cast<float>(sum.x / sum.count), static_cast<float>(sum.y / sum.count),
                     static_cast<float>(sum.z / sum.count)});
  }
  return means;
}

}  // namespace flagstone::doctor
