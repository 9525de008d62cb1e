// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "app/doctor/faults.hpp"

#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>

#include "app/doctor/street_scan.hpp"
#include "library/core/random.hpp"

namespace flagstone::doctor {
namespace {

using Points = std::vector<Point>;
using Change = std::function<Points(const Points&)>;

Change each(std::function<Point(Point)> change) {
  return [change](const Points& points) { return changed(points, change); };
}

Points every(std::size_t nth, const Points& points, Point becomes) {
  Points result = points;
  for (std::size_t i = 0; i < result.size(); i += nth) result[i] = becomes;
  return result;
}

Points every_tenth_twice(const Points& points) {
  Points result;
  for (std::size_t i = 0; i < points.size(); ++i) {
    result.insert(result.end(), i % 10 == 0 ? 2 : 1, points[i]);
  }
  return result;
}

/// Rotated about x, then about y, degrees.
Point turned(Point p, double about_x, double about_y) {
  const double x_angle = about_x * std::numbers::pi / 180;
  const double y_angle = about_y * std::numbers::pi / 180;
  const double y = p.y * std::cos(x_angle) - p.z * std::sin(x_angle);
  const double z = p.y * std::sin(x_angle) + p.z * std::cos(x_angle);
  return {static_cast<float>(p.x * std::cos(y_angle) + z * std::sin(y_angle)),
          static_cast<float>(y),
          static_cast<float>(-p.x * std::sin(y_angle) + z * std::cos(y_angle))};
}

/// Shuffled, and with beams so thick (a third of a degree) that they touch each other.
Points without_rings(const Points& points) {
  Random random(5);
  return shuffled(changed(points, [&](Point p) {
    const double error = random.uniform(-0.003, 0.003) * std::hypot(p.x, p.y);
    return Point{p.x, p.y, p.z + static_cast<float>(error)};
  }));
}

/// With a roof 30 cm below the sensor, denser close to it.
Points with_a_roof(const Points& points) {
  Points result = points;
  Random random(2);
  for (int i = 0; i < 4000; ++i) {
    const double azimuth = random.uniform(0, 2 * std::numbers::pi);
    const double range = random.uniform(0.5, 1.2);
    result.push_back({static_cast<float>(range * std::cos(azimuth)),
                      static_cast<float>(range * std::sin(azimuth)), -0.3f});
  }
  return result;
}

/// Only the points above the sensor, so that no ground is left.
Points above_the_sensor(const Points& points) {
  Points result;
  for (const Point& p : points) {
    if (p.z > 0) result.push_back(p);
  }
  return result;
}

/// An airborne scan: hills, about one point per square metre, the origin on the ground in the
/// centre.
Points from_the_air(const Points&) {
  Points points;
  Random random(3);
  for (int i = 0; i < 40000; ++i) {
    const double x = random.uniform(-100, 100);
    const double y = random.uniform(-100, 100);
    const double z = 8 * std::sin(x / 25) * std::cos(y / 30);
    points.push_back({static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)});
  }
  return points;
}

std::vector<Fault> make_faults() {
  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  using enum Severity;
  return {
      {"FewPoints", "points", fix,
       [](const Points& p) { return Points(p.begin(), p.begin() + 900); }},
      {"ZeroReturns", "zero_returns", note, [](const Points& p) { return every(4, p, {0, 0, 0}); }},
      {"NotFinite", "not_finite", note, [](const Points& p) { return every(9, p, {1, nan, 2}); }},
      {"RepeatedPoints", "duplicate_points", note, every_tenth_twice},
      {"MapCoordinates", "coordinates", fix,
       each([](Point p) { return Point{p.x + 512345, p.y + 5401234, p.z + 112}; })},
      {"FromTheAir", "single_viewpoint", fix, from_the_air, {}, {"ground", "beams"}},
      {"Millimetres", "units", fix,
       each([](Point p) { return Point{1000 * p.x, 1000 * p.y, 1000 * p.z}; })},
      {"Centimetres", "units", fix,
       each([](Point p) { return Point{100 * p.x, 100 * p.y, 100 * p.z}; })},
      {"UpsideDown", "axes", fix, each([](Point p) { return Point{p.x, -p.y, -p.z}; })},
      {"CameraFrame", "axes", fix, each([](Point p) { return Point{-p.y, -p.z, p.x}; })},
      {"YUp", "axes", fix, each([](Point p) { return Point{-p.y, p.z, -p.x}; })},
      {"XUp", "axes", fix, each([](Point p) { return Point{p.z, p.x, p.y}; })},
      {"XDown", "axes", fix, each([](Point p) { return Point{-p.z, p.y, p.x}; })},
      {"Pitched", "tilt", fix, each([](Point p) { return turned(p, 0, 20); })},
      {"Rolled", "tilt", fix, each([](Point p) { return turned(p, -15, 0); })},
      {"PitchedAndRolled", "tilt", fix, each([](Point p) { return turned(p, 10, -10); })},
      {"OriginOnTheGround", "origin", fix,
       each([](Point p) { return Point{p.x, p.y, p.z + 1.73f}; })},
      {"OriginBelowTheGround", "origin", fix,
       each([](Point p) { return Point{p.x, p.y, p.z + 31.73f}; })},
      {"OriginAtTheAxle", "origin", fix, each([](Point p) { return Point{p.x, p.y, p.z + 1.4f}; })},
      {"OriginOnTheGroundAndNoRings",
       "origin",
       fix,
       [](const Points& p) {
         return shuffled(changed(p, [](Point q) { return Point{q.x, q.y, q.z + 1.73f}; }));
       },
       {},
       {"beams"}},
      {"OriginAtTheAxleAndNoBeams",
       "origin",
       note,
       [](const Points& p) {
         return changed(without_rings(p), [](Point q) { return Point{q.x, q.y, q.z + 1.4f}; });
       },
       {.sensor_height = 0.33f},
       {"beams"}},
      {"HeightTooLow", "sensor_height", fix, each(std::identity()), {.sensor_height = 1.2f}},
      {"HeightTooHigh", "sensor_height", fix, each(std::identity()), {.sensor_height = 2.2f}},
      {"NoGround", "ground", fix, above_the_sensor},
      {"OwnRoof", "ego_vehicle", note, with_a_roof},
      {"NoRings", "beams", note, without_rings},
      {"BeyondTheMethodsRange", "range", note, each(std::identity()), {.max_range = 40.0f}},
      {"VoxelAveraged", "downsampling", note,
       [](const Points& p) { return voxel_means(p, 0.15f); }},
  };
}

}  // namespace

const std::vector<Fault>& faults() {
  static const std::vector<Fault> all = make_faults();
  return all;
}

}  // namespace flagstone::doctor
