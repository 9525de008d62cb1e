// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "app/doctor/examination.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "app/doctor/street_scan.hpp"

namespace flagstone::doctor {
namespace {

double azimuth(const Point& p) { return std::atan2(p.y, p.x) * 180 / std::numbers::pi; }

double elevation(const Point& p) {
  return std::atan2(p.z, std::hypot(p.x, p.y)) * 180 / std::numbers::pi;
}

/// The points of the street for which `keep` is true.
template <class Keep>
std::vector<Point> street_where(Keep keep) {
  std::vector<Point> kept;
  for (const Point& p : street_scan()) {
    if (keep(p)) kept.push_back(p);
  }
  return kept;
}

TEST(Examination, CountsInvalidPoints) {
  std::vector<Point> points = street_scan();
  points[0] = {0, 0, 0};
  points[1] = {INFINITY, 0, 0};
  points[2] = {0, NAN, 0};
  points[4] = points[3];

  const Examination seen = examine(cloud_of(points));

  EXPECT_EQ(seen.points, points.size());
  EXPECT_EQ(seen.zero, 1u);
  EXPECT_EQ(seen.not_finite, 2u);
  EXPECT_EQ(seen.usable(), points.size() - 3);
  EXPECT_EQ(seen.repeated, 1u);
}

TEST(Examination, CountsTheBeamsOfPointsListedRingByRing) {
  const Examination seen = examine(cloud_of(street_scan()));

  EXPECT_EQ(seen.rings, RingSource::order);
  EXPECT_EQ(seen.view.beams, 64);
}

TEST(Examination, CountsTheRingsOfAFieldInAnyOrder) {
  const std::vector<Point> points = shuffled(street_scan());
  std::vector<float> rings;
  rings.reserve(points.size());
  for (const Point& p : points) rings.push_back(elevation(p) > -8.5 ? 7.0f : 3.0f);

  const Examination seen = examine(cloud_of(points, rings));

  EXPECT_EQ(seen.rings, RingSource::field);
  EXPECT_EQ(seen.view.beams, 2);
}

TEST(Examination, CountsSeparateBeamsByElevationInAnyOrder) {
  // Every fourth beam of the upper block, 4/3 of a degree apart.
  const auto is_one_of_eight = [](const Point& p) {
    const double beam = (2 - elevation(p)) * 3;
    return beam < 31 && std::abs(std::remainder(beam, 4.0)) < 0.4;
  };

  const Examination seen = examine(cloud_of(shuffled(street_where(is_one_of_eight))));

  EXPECT_EQ(seen.rings, RingSource::none);
  EXPECT_EQ(seen.view.beams, 8);
}

TEST(Examination, MeasuresTheFieldOfView) {
  const FieldOfView all = examine(cloud_of(street_scan())).view;
  EXPECT_TRUE(all.sees_all_around());
  EXPECT_NEAR(all.bottom, -24.33, 0.1);
  EXPECT_NEAR(all.top, 2, 0.1);

  const auto is_ahead = [](const Point& p) { return azimuth(p) > -20 && azimuth(p) < 40; };
  const FieldOfView ahead = examine(cloud_of(street_where(is_ahead))).view;
  EXPECT_FALSE(ahead.sees_all_around());
  EXPECT_NEAR(ahead.azimuth_begin, -20, 1.1);
  EXPECT_NEAR(ahead.azimuth_width, 60, 2.1);
  EXPECT_EQ(ahead.beams, 64);
}

TEST(Examination, MeasuresTheReachInMetres) {
  std::vector<float> ranges;
  for (const Point& p : street_scan()) ranges.push_back(std::hypot(p.x, p.y, p.z));
  const auto metres_to_cm = [](Point p) { return Point{100 * p.x, 100 * p.y, 100 * p.z}; };

  const Extent extent = examine(cloud_of(changed(street_scan(), metres_to_cm))).extent;

  EXPECT_EQ(extent.metres, 0.01);
  EXPECT_NEAR(extent.farthest, 100 * *std::ranges::max_element(ranges), 1);
}

TEST(Examination, FindsNothingWithoutPoints) {
  EXPECT_FALSE(examine(cloud_of({})).has_enough_points());
}

}  // namespace
}  // namespace flagstone::doctor
