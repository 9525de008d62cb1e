// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "forced_target.hpp"
#include "library/core/simd_target.hpp"
#include "library/plane_fits/bin_batch.hpp"
#include "library/surface/patch_judge.hpp"

namespace flagstone::surface {
namespace {

using plane_fits::BinBatch;
using plane_fits::MovedPoint;

/// A point at (x, y) of a patch, `distance` above its plane.
MovedPoint point_above(const Plane& plane, float x, float y, double distance) {
  const auto [nx, ny, nz] = plane.normal;
  const double z =
      (distance - plane.d - nx * static_cast<double>(x) - ny * static_cast<double>(y)) / nz;
  return {.x = x, .y = y, .z = static_cast<float>(z), .index = 0};
}

/// Adds a bin of these points, with 16 more readable points.
void add(BinBatch& batch, std::vector<MovedPoint> points) {
  const std::size_t count = points.size();
  points.resize(count + 16);
  batch.add_sample({points.data(), count}, 1000);
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
    std::vector<MovedPoint> points;
    // The origin is midway between the first and the last point, so both have the same position.
    for (const double distance : distances) {
      const float x = static_cast<float>(random() % 100) / 50 - 1;
      const bool is_end = points.empty() || points.size() + 1 == distances.size();
      points.push_back(point_above(plane, is_end ? 0 : x, 0, distance));
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
    std::vector<MovedPoint> points(i + 1, point_above(plane, 0, 0, 0));
    points.push_back(point_above(plane, 0, 0, 0.5));
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
