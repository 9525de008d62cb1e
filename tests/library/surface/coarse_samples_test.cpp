// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "library/surface/coarse_samples.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <span>
#include <string>
#include <vector>

#include "forced_target.hpp"
#include "library/core/simd_target.hpp"
#include "library/plane_fits/ground_sets.hpp"
#include "library/surface/square_scan.hpp"
#include "library/surface/vector_functions.hpp"
#include "numbers.hpp"

namespace flagstone::surface {
namespace {

using plane_fits::BinBatch;
using plane_fits::ExactGrid;

/// A cloud and its samples.
struct Sampled {
  explicit Sampled(const std::vector<Point>& cloud) : scan(cloud), samples(scan.cells) {
    samples.reserve(cloud.size());
    samples.take(scan.points);
  }

  tests::SquareScan scan;
  CoarseSamples samples;
};

std::vector<PackedPoint> sorted(std::span<const PackedPoint> points) {
  std::vector<PackedPoint> list(points.begin(), points.end());
  std::ranges::sort(list);
  return list;
}

/// The samples of all coarse cells, each sorted.
std::vector<std::vector<PackedPoint>> lists_of(const Sampled& sampled) {
  std::vector<std::vector<PackedPoint>> lists;
  const auto count =
      coarse_cells_of_block * static_cast<std::uint32_t>(sampled.scan.cells.blocks().size());
  for (std::uint32_t i = 0; i < count; ++i) {
    lists.push_back(sorted(sampled.samples.points(i, i + 1)));
  }
  return lists;
}

/// The points of a patch of the batch, relative to its origin, sorted.
std::vector<std::array<float, 3>> points_of(const BinBatch& batch, std::size_t i) {
  std::vector<std::array<float, 3>> points;
  for (std::size_t k = 0; k < batch.size(i); ++k) {
    points.push_back({batch.x(i)[k], batch.y(i)[k], batch.z(i)[k]});
  }
  std::ranges::sort(points);
  return points;
}

bool is_multiple(float value, float step) { return std::remainder(value, step) == 0; }

/// Random points in a patch.
std::vector<Point> cloud_around(const SquarePatch& patch, std::size_t count) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> inside(-0.499f * patch.size, 0.499f * patch.size);
  std::uniform_real_distribution<float> height(-2.5f, 1);
  std::vector<Point> cloud(count);
  for (Point& p : cloud) {
    p = {.x = patch.x + inside(random), .y = patch.y + inside(random), .z = height(random)};
  }
  return cloud;
}

/// The parameter is the instruction set.
class CoarseSamplesOn : public testing::TestWithParam<std::string> {
 protected:
  /// A near patch of 4 m and a far one of 8 m.
  [[nodiscard]] static std::vector<SquarePatch> two_patches() {
    const SquareCells cells{SurfaceConfig{}};
    const SquarePatches patches({}, cells);
    return {patches.list()[10], patches.list()[400]};
  }

 private:
  tests::ForcedTarget forced_{GetParam()};
};

INSTANTIATE_TEST_SUITE_P(Target, CoarseSamplesOn, testing::ValuesIn(simd_targets()),
                         [](const auto& target) { return target.param; });

TEST_P(CoarseSamplesOn, ContainAllPointsOfSmallCellsAndASampleOfLargeCells) {
  const Sampled sampled(tests::random_cloud(100000, 1));
  std::size_t small = 0;
  std::size_t large = 0;
  std::uint32_t coarse = 0;
  for (const CellRange& block : sampled.scan.cells.blocks()) {
    const std::uint32_t each = (block.last - block.first) / coarse_cells_of_block;
    for (std::uint32_t i = 0; i < coarse_cells_of_block; ++i, ++coarse) {
      const std::uint32_t first = block.first + i * each;
      const std::span<const PackedPoint> all = sampled.scan.points.points(first, first + each);
      const std::span<const PackedPoint> taken = sampled.samples.points(coarse, coarse + 1);
      ASSERT_LE(taken.size(), CoarseSamples::most);
      if (all.size() <= CoarseSamples::most) {
        ASSERT_EQ(sorted(taken), sorted(all));
        small += all.empty() ? 0U : 1U;
      } else {
        ASSERT_EQ(sorted(taken),
                  sorted(tests::sample_of({all.begin(), all.end()}, {.most = 32, .wanted = 24})));
        ++large;
      }
    }
  }
  EXPECT_GT(small, 100U);
  EXPECT_GT(large, 100U);
}

TEST_P(CoarseSamplesOn, DoNotDependOnTheOrderOfThePoints) {
  std::vector<Point> cloud = tests::random_cloud(60000, 2);
  const std::vector<std::vector<PackedPoint>> expected = lists_of(Sampled(cloud));
  for (std::uint32_t seed = 0; seed < 3; ++seed) {
    std::ranges::shuffle(cloud, std::mt19937(seed));

    EXPECT_EQ(lists_of(Sampled(cloud)), expected);
  }
}

TEST_P(CoarseSamplesOn, APatchHasItsPointsToWithinAUnit) {
  for (const SquarePatch& patch : two_patches()) {
    const std::vector<Point> cloud = cloud_around(patch, 60);
    const Sampled sampled(cloud);
    BinBatch batch;
    batch.reserve(128);
    batch.clear();

    sampled.samples.add_patch(patch, batch);

    ASSERT_EQ(batch.size(0), cloud.size());
    for (const Point& p : cloud) {
      const auto is_near = [&](const std::array<float, 3>& packed) {
        const BinBatch::Origin origin = batch.origin(0);
        return std::abs(packed[0] + origin.x - p.x) < 0.5f / xy_per_metre + 1e-4f &&
               std::abs(packed[1] + origin.y - p.y) < 0.5f / xy_per_metre + 1e-4f &&
               // rounded twice
               std::abs(packed[2] + origin.z - p.z) < 1.5f / z_per_metre + 1e-4f;
      };
      ASSERT_EQ(std::ranges::count_if(points_of(batch, 0), is_near), 1) << p.x << ", " << p.y;
    }
  }
}

TEST_P(CoarseSamplesOn, APatchLiesOnTheExactGrid) {
  for (const SquarePatch& patch : two_patches()) {
    for (const std::size_t count : {1U, 15U, 17U, 128U, 2000U}) {
      const Sampled sampled(cloud_around(patch, count));
      BinBatch batch;
      batch.reserve(2 * ExactGrid::most_points);
      batch.clear();
      sampled.samples.add_patch(patch, batch);
      sampled.samples.add_patch(patch, batch);

      ASSERT_EQ(batch.count(), 2U);
      ASSERT_LE(batch.size(1), ExactGrid::most_points);
      EXPECT_EQ(points_of(batch, 0), points_of(batch, 1));
      for (const auto& [x, y, z] : points_of(batch, 1)) {
        EXPECT_TRUE(is_multiple(x, ExactGrid::xy_step)) << x;
        EXPECT_TRUE(is_multiple(y, ExactGrid::xy_step)) << y;
        EXPECT_TRUE(is_multiple(z, ExactGrid::z_step)) << z;
        EXPECT_LE(std::max(std::abs(x), std::abs(y)), patch.size / 2);
      }
      for (std::size_t k = batch.size(1); k < batch.places(1); ++k) {
        EXPECT_EQ(batch.x(1)[k], 0);
        EXPECT_EQ(batch.y(1)[k], 0);
        EXPECT_EQ(batch.z(1)[k], inf);
      }
    }
  }
}

TEST_P(CoarseSamplesOn, APatchDoesNotDependOnTheOrderOfThePoints) {
  std::vector<Point> cloud = tests::random_cloud(60000, 3);
  const Sampled first(cloud);
  std::ranges::shuffle(cloud, std::mt19937(1));
  const Sampled second(cloud);
  std::size_t sampled = 0;
  const SquarePatches patches({}, first.scan.cells);
  for (const SquarePatch& patch : patches.list()) {
    BinBatch batch;
    batch.reserve(2 * ExactGrid::most_points);
    batch.clear();
    first.samples.add_patch(patch, batch);
    second.samples.add_patch(patch, batch);
    ASSERT_EQ(points_of(batch, 0), points_of(batch, 1)) << patch.x << ", " << patch.y;
    const std::size_t held = first.scan.points.points(patch.cells.first, patch.cells.last).size();
    sampled += batch.size(0) < held ? 1U : 0U;
  }
  EXPECT_GT(sampled, 20U);
}

TEST_P(CoarseSamplesOn, APatchHasAllItsPointsIfTheyAreFew) {
  const Sampled sampled(tests::random_cloud(3000, 4));
  const SquarePatches patches({}, sampled.scan.cells);
  std::size_t compared = 0;
  for (const SquarePatch& patch : patches.list()) {
    const std::size_t held = sampled.scan.points.points(patch.cells.first, patch.cells.last).size();
    if (held > CoarseSamples::most) continue;  // can be a sample
    BinBatch batch;
    batch.reserve(ExactGrid::most_points);
    batch.clear();
    sampled.samples.add_patch(patch, batch);
    ASSERT_EQ(batch.size(0), held) << patch.x << ", " << patch.y;
    compared += held > 0 ? 1U : 0U;
  }
  EXPECT_GT(compared, 50U);
}

}  // namespace
}  // namespace flagstone::surface
