// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "flagstone/cloud_view.hpp"
#include "forced_target.hpp"
#include "library/core/simd_target.hpp"
#include "library/plane_fits/bin_batch.hpp"
#include "library/surface/patch_judge.hpp"
#include "numbers.hpp"

namespace flagstone::surface {
namespace {

using plane_fits::BinBatch;

/// A point at x of a patch, `distance` above its plane.
Point point_above(const Plane& plane, float x, double distance) {
  const double z =
      (distance - plane.d - plane.normal[0] * static_cast<double>(x)) / plane.normal[2];
  return {.x = x, .y = 0, .z = static_cast<float>(z)};
}

/// Adds a bin of these points.
void add(BinBatch& batch, const std::vector<Point>& points) {
  const std::size_t i = batch.count();
  batch.add_empty(points.size(), {.x = 0, .y = 0});
  for (std::size_t k = 0; k < batch.places(i); ++k) {
    const Point p = k < points.size() ? points[k] : Point{.x = 0, .y = 0, .z = inf};
    batch.x(i)[k] = p.x;
    batch.y(i)[k] = p.y;
    batch.z(i)[k] = p.z;
  }
}

void set(PlaneBatch& planes, std::size_t i, const Plane& plane) {
  for (std::size_t axis = 0; axis < 3; ++axis) planes.normal[axis][i] = plane.normal[axis];
  planes.d[i] = plane.d;
}

Plane tilted(double slope) {
  const double length = std::hypot(slope, 1.0);
  return {.normal = {-slope / length, 0, 1 / length}, .d = 1.7 / length};
}

/// The parameter is the instruction set.
class SlabCountsOn : public testing::TestWithParam<std::string> {
 protected:
  /// The counts of one patch. Both the batch and the plane use coordinates relative to the origin
  /// of the bin.
  SlabCounts count(const Plane& plane, const std::vector<double>& distances) {
    std::mt19937 random(1);
    std::vector<Point> points;
    for (const double distance : distances) {
      const float x = static_cast<float>(random() % 100) / 50 - 1;
      points.push_back(point_above(plane, x, distance));
    }
    BinBatch batch;
    batch.reserve(1100);
    batch.clear();
    add(batch, points);
    PlaneBatch planes{};
    set(planes, 0, plane);
    return count_slabs(batch, planes)[0];
  }

 private:
  tests::ForcedTarget forced_{GetParam()};
};

INSTANTIATE_TEST_SUITE_P(Target, SlabCountsOn, testing::ValuesIn(simd_targets()),
                         [](const auto& target) { return target.param; });

TEST_P(SlabCountsOn, CountPointsWithin125MillimetresAndInTheSlabAbove) {
  for (const double slope : {0.0, 0.3, -0.5}) {
    const SlabCounts counts =
        count(tilted(slope), {-0.126, -0.124, 0, 0.124, 0.126, 0.187, 0.188, 0.5, 0.887, 0.888});

    EXPECT_EQ(counts.within, 3U);
    EXPECT_EQ(counts.above, 3U);
  }
}

TEST_P(SlabCountsOn, MatchCountingPointsOneByOne) {
  std::mt19937 random(2);
  for (const std::size_t size : {1U, 15U, 16U, 17U, 128U, 1000U}) {
    std::vector<double> distances;
    std::uint32_t within = 0;
    std::uint32_t above = 0;
    for (std::size_t i = 0; i < size; ++i) {
      const double distance =
          static_cast<double>(random() % 2000) / 1000 - 0.4997;  // never exactly a limit
      distances.push_back(distance);
      if (std::abs(distance) < 0.125) ++within;
      if (distance > 0.1875 && distance < 0.8875) ++above;
    }

    const SlabCounts counts = count(tilted(0.25), distances);

    EXPECT_EQ(counts.within, within) << size;
    EXPECT_EQ(counts.above, above) << size;
  }
}

TEST_P(SlabCountsOn, UseThePlaneOfEachPatch) {
  BinBatch batch;
  batch.reserve(512);
  PlaneBatch planes{};
  for (std::size_t i = 0; i < batch_size; ++i) {
    const Plane plane = tilted(0.05 * static_cast<double>(i));
    set(planes, i, plane);
    std::vector<Point> points(i + 1, point_above(plane, 0, 0));
    points.push_back(point_above(plane, 0, 0.5));
    add(batch, points);
  }

  const auto counts = count_slabs(batch, planes);

  for (std::size_t i = 0; i < batch_size; ++i) {
    EXPECT_EQ(counts[i].within, i + 1);
    EXPECT_EQ(counts[i].above, 1U);
  }
}

}  // namespace
}  // namespace flagstone::surface
