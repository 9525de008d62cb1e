// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "library/plane_fits/bin_batch.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "forced_target.hpp"
#include "library/plane_fits/sorted_scan.hpp"

namespace flagstone::plane_fits {
namespace {

/// The parameter is the instruction set.
class BinBatchOn : public testing::TestWithParam<std::string> {
 protected:
  /// Gathers all bins of the scan, sixteen at a time, and compares each bin with its points.
  static void expect_gathered(const std::vector<Point>& cloud) {
    const tests::SortedScan sorted(cloud, {});
    BinBatch batch;
    batch.reserve(cloud.size());
    std::size_t gathered = 0;
    for (std::uint32_t bin = 0; bin < sorted.zones.bin_count();) {
      batch.clear();
      for (; bin < sorted.zones.bin_count() && batch.count() < batch_size; ++bin) {
        if (sorted.groups.size(bin) > 0) batch.add(bin, sorted.groups.size(bin));
      }
      batch.gather(sorted.scan, sorted.groups);
      for (std::size_t i = 0; i < batch.count(); ++i) expect_gathered(sorted, batch, i, cloud);
      gathered += batch.count();
    }
    EXPECT_GT(gathered, 0U);
  }

  static void expect_padded(const BinBatch& batch, std::size_t i) {
    ASSERT_EQ(batch.places(i) % 16, 0U);
    for (std::size_t k = batch.size(i); k < batch.places(i); ++k) {
      ASSERT_EQ(batch.x(i)[k], 0);
      ASSERT_EQ(batch.y(i)[k], 0);
      ASSERT_EQ(batch.z(i)[k], std::numeric_limits<float>::infinity());
    }
  }

 private:
  static void expect_gathered(const tests::SortedScan& sorted, const BinBatch& batch, std::size_t i,
                              const std::vector<Point>& cloud) {
    const std::vector<std::uint32_t> points = tests::points_of(sorted.groups, batch.bin(i));
    const Point& first = cloud[points.front()];
    const Point& last = cloud[points.back()];
    ASSERT_EQ(batch.size(i), points.size());
    ASSERT_EQ(batch.origin(i).x, (first.x + last.x) / 2);
    ASSERT_EQ(batch.origin(i).y, (first.y + last.y) / 2);
    ASSERT_EQ(batch.origin(i).z, 0);
    for (std::size_t k = 0; k < points.size(); ++k) {
      ASSERT_EQ(batch.x(i)[k], cloud[points[k]].x - batch.origin(i).x);
      ASSERT_EQ(batch.y(i)[k], cloud[points[k]].y - batch.origin(i).y);
      ASSERT_EQ(batch.z(i)[k], cloud[points[k]].z);
    }
    expect_padded(batch, i);
  }

  tests::ForcedTarget forced{GetParam()};
};

INSTANTIATE_TEST_SUITE_P(Target, BinBatchOn, testing::ValuesIn(simd_targets()),
                         [](const auto& target) { return target.param; });

TEST_P(BinBatchOn, ContainsThePointsOfItsBinsRelativeToTheirOrigins) {
  expect_gathered(tests::random_cloud(60000, 1));
}

TEST_P(BinBatchOn, ContainsThePointsOfAnUnorderedCloud) {
  std::vector<Point> cloud = tests::random_cloud(60000, 2);
  std::ranges::shuffle(cloud, std::mt19937(1));
  expect_gathered(cloud);
}

TEST_P(BinBatchOn, ContainsThePointsOfSmallBins) {
  for (std::size_t size = 20; size < 60; ++size) {
    expect_gathered(tests::random_cloud(size, static_cast<std::uint32_t>(size)));
  }
}

TEST_P(BinBatchOn, ContainsABinOfAnySize) {
  for (std::size_t size = 1; size <= 70; ++size) {
    std::vector<Point> cloud;
    for (std::size_t i = 0; i < size; ++i) {
      const auto step = static_cast<float>(i);
      cloud.push_back({6.5f + 0.01f * step, 0.7f, -1.7f - 0.01f * step});
    }
    expect_gathered(cloud);
  }
}

TEST(BinBatch, ACallerCanWriteThePointsOfABin) {
  BinBatch batch;
  batch.reserve(100);
  batch.clear();
  const std::array<std::size_t, 4> sizes = {1, 16, 17, 66};
  for (const std::size_t size : sizes) {
    const auto number = static_cast<float>(size);
    batch.add_empty(size, {.x = number, .y = -number, .z = 0.5f});
  }

  for (std::size_t i = 0; i < sizes.size(); ++i) {
    std::fill_n(batch.x(i), batch.places(i), static_cast<float>(i));
    std::fill_n(batch.y(i), batch.places(i), static_cast<float>(i) + 10);
    std::fill_n(batch.z(i), batch.places(i), static_cast<float>(i) + 20);
  }

  ASSERT_EQ(batch.count(), sizes.size());
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    const auto number = static_cast<float>(sizes.at(i));
    EXPECT_EQ(batch.size(i), sizes.at(i));
    EXPECT_EQ(batch.places(i) % 16, 0U);
    EXPECT_EQ(batch.origin(i).x, number);
    EXPECT_EQ(batch.origin(i).y, -number);
    EXPECT_EQ(batch.origin(i).z, 0.5f);
    for (std::size_t k = 0; k < batch.places(i); ++k) {
      ASSERT_EQ(batch.x(i)[k], static_cast<float>(i)) << k;
      ASSERT_EQ(batch.y(i)[k], static_cast<float>(i) + 10) << k;
      ASSERT_EQ(batch.z(i)[k], static_cast<float>(i) + 20) << k;
    }
  }
}

}  // namespace
}  // namespace flagstone::plane_fits
