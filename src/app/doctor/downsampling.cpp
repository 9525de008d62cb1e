// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "app/doctor/downsampling.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "library/core/statistics.hpp"

namespace flagstone::doctor {
namespace {

/// The points in one cell of elevation and azimuth.
struct Direction {
  double points = 0;
  double ranges = 0;   // their sum
  double squares = 0;  // of ranges, their sum

  [[nodiscard]] double range() const { return ranges / points; }
  /// True if the points have similar ranges, so that they are probably on one object.
  [[nodiscard]] bool is_even() const {
    const double variance = squares / points - range() * range();
    constexpr double most = 0.15;  // of the range
    return variance < most * most * range() * range();
  }
};

constexpr std::size_t columns = 180;  // 2 degrees each
constexpr std::size_t rows = 180;     // 1 degree each

std::vector<Direction> directions_of(std::span<const Vector3f> places) {
  std::vector<Direction> directions(rows * columns);
  constexpr double degrees = 180 / std::numbers::pi;
  for (const Vector3f& place : places) {
    const double x = place[0];
    const double y = place[1];
    const double z = place[2];
    const double azimuth = (std::atan2(y, x) * degrees + 180) / 2;
    const double elevation = std::atan2(z, std::hypot(x, y)) * degrees + 90;
    const auto column = std::min(static_cast<std::size_t>(azimuth), columns - 1);
    const auto row = std::min(static_cast<std::size_t>(elevation), rows - 1);
    const double range = std::hypot(x, y, z);
    Direction& direction = directions[row * columns + column];
    ++direction.points;
    direction.ranges += range;
    direction.squares += range * range;
  }
  return directions;
}

/// Number of points in a full direction. Many directions are partly empty: at edges of objects, and
/// where returns are missing.
double full_count(std::span<const Direction> directions) {
  std::vector<double> counts;
  for (const Direction& direction : directions) counts.push_back(direction.points);
  return percentile(counts, 80);
}

double mean_range(std::span<const Direction> directions) {
  double sum = 0;
  for (const Direction& direction : directions) sum += direction.range();
  return sum / static_cast<double>(directions.size());
}

/// Compares the nearer with the farther directions of each row.
double growth_of(std::span<const Direction> directions, double farthest) {
  constexpr double nearest = 2.7;         // the ego vehicle
  constexpr std::size_t fewest = 30;      // directions per row
  constexpr double least_distance = 0.2;  // between near and far, logarithm
  double product = 0;
  double square = 0;
  for (std::size_t row = 0; row < rows; ++row) {
    std::vector<Direction> even;
    for (std::size_t column = 0; column < columns; ++column) {
      const Direction& direction = directions[row * columns + column];
      if (direction.points == 0 || !direction.is_even()) continue;
      const double range = direction.range();
      if (range > nearest && range < farthest) even.push_back(direction);
    }
    if (even.size() < fewest) continue;
    std::ranges::sort(even, {}, &Direction::range);
    const std::span<const Direction> all(even);
    const auto near = all.first(even.size() / 3);
    const auto far = all.last(even.size() / 3);
    const double distance = std::log(mean_range(far) / mean_range(near));
    if (distance < least_distance) continue;
    product += distance * std::log(full_count(far) / full_count(near));
    square += distance * distance;
  }
  return square > 0 ? product / square : 0;
}

double crowding_of(std::span<const Vector3f> places, double radius) {
  double near = 0;
  double far = 0;
  for (const Vector3f& place : places) {
    const double range = std::hypot(double{place[0]}, double{place[1]});
    if (range < radius / 4) ++near;
    if (range >= radius / 2 && range < radius) ++far;
  }
  // The areas have a ratio of 1 to 12.
  return 12 * near / std::max(far, 1.0);
}

}  // namespace

Downsampling find_downsampling(std::span<const Vector3f> places) {
  std::vector<double> ranges;
  ranges.reserve(places.size());
  for (const Vector3f& place : places) {
    ranges.push_back(std::hypot(double{place[0]}, double{place[1]}));
  }
  const double radius = percentile(ranges, 90);
  const std::vector<Direction> directions = directions_of(places);
  constexpr double near_by = 30;
  return {.growth = growth_of(directions, near_by),
          .growth_of_all = growth_of(directions, radius),
          .crowding = crowding_of(places, radius)};
}

}  // namespace flagstone::doctor
