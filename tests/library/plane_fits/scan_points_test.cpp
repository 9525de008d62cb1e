// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "library/plane_fits/scan_points.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <bit>
#include <cstdint>
#include <string>
#include <vector>

#include "forced_target.hpp"
#include "library/patchwork/concentric_zones.hpp"
#include "library/plane_fits/square_cells.hpp"
#include "random_cloud.hpp"

namespace flagstone::plane_fits {
namespace {

using patchwork::ConcentricZones;
using patchwork::read_chunk;
using tests::view_of;

/// The bin of each point according to ConcentricZones.
std::vector<std::uint32_t> located(const std::vector<Point>& cloud, const ConcentricZones& zones) {
  std::vector<float> x;
  std::vector<float> y;
  std::vector<float> z;
  for (const Point& p : cloud) {
    x.push_back(p.x);
    y.push_back(p.y);
    z.push_back(p.z);
  }
  std::vector<std::uint32_t> bins(cloud.size());
  zones.locate(x.data(), y.data(), z.data(), cloud.size(), bins.data());
  return bins;
}

void read_all(const std::vector<Point>& cloud, const ConcentricZones& zones, ScanPoints& scan) {
  scan.reserve(cloud.size());
  for (std::size_t chunk = 0; chunk < chunk_count(cloud.size()); ++chunk) {
    read_chunk(view_of(cloud), chunk, zones, scan);
  }
}

/// The bin of each point according to the runs. If the runs do not cover every point exactly once,
/// the number of elements differs from the number of points.
std::vector<std::uint32_t> told_by_runs(const ScanPoints& scan, std::size_t points) {
  std::vector<std::uint32_t> bins;
  for (std::size_t chunk = 0; chunk < chunk_count(points); ++chunk) {
    const auto [starts, count, first] = scan.runs().chunk(chunk);
    for (std::size_t i = 0; i < count; ++i) {
      const std::uint32_t begin = starts[i] >> bin_bits;
      const std::uint32_t end = starts[i + 1] >> bin_bits;
      if (first + begin != bins.size() || end <= begin) return {};
      bins.insert(bins.end(), end - begin, starts[i] & bin_mask);
    }
  }
  return bins;
}

PatchworkConfig many_rings() {
  PatchworkConfig config;
  config.zones = {{.ring_radii = equal_rings(config.min_range, 80, 1000), .sectors = 65}};
  return config;
}

/// The parameter is the instruction set.
class ScanPointsOn : public testing::TestWithParam<std::string> {
  tests::ForcedTarget forced{GetParam()};
};

INSTANTIATE_TEST_SUITE_P(Target, ScanPointsOn, testing::ValuesIn(simd_targets()),
                         [](const auto& target) { return target.param; });

TEST_P(ScanPointsOn, RunsContainTheBinOfEveryPoint) {
  const std::vector<ConcentricZones> layouts{ConcentricZones(PatchworkConfig{}),
                                             ConcentricZones(many_rings())};
  EXPECT_TRUE(rc::check([&] {
    const auto size = *rc::gen::oneOf(rc::gen::inRange<std::size_t>(1, 100),
                                      rc::gen::inRange<std::size_t>(8100, 8300));
    const auto seed = *rc::gen::inRange<std::uint32_t>(0, 1000);
    const std::vector<Point> cloud = *rc::gen::arbitrary<bool>()
                                         ? tests::corrupted_cloud(size, seed)
                                         : tests::random_cloud(size, seed);
    const ConcentricZones& zones = layouts[*rc::gen::inRange<std::size_t>(0, 2)];
    ScanPoints scan;

    read_all(cloud, zones, scan);

    RC_ASSERT(told_by_runs(scan, size) == located(cloud, zones));
  }));
}

TEST_P(ScanPointsOn, RunsContainTheBinForAnyWayOfFindingIt) {
  constexpr tests::SquareCells cells{.cell = 0.25f,
                                     .width = 511};  // 261,122 bins: nearly the maximum
  for (const std::size_t size : {1U, 16U, 17U, 8193U, 20000U}) {
    const std::vector<Point> cloud = tests::corrupted_cloud(size, 6);
    ScanPoints scan;
    scan.reserve(size);

    for (std::size_t chunk = 0; chunk < chunk_count(size); ++chunk) {
      read_chunk(view_of(cloud), chunk, cells, scan);
    }

    std::vector<std::uint32_t> expected;
    for (const Point& point : cloud) expected.push_back(cells.cell_of(point));
    ASSERT_EQ(told_by_runs(scan, size), expected);
  }
}

TEST_P(ScanPointsOn, RunsAreAsLongAsPossible) {
  const ConcentricZones zones{PatchworkConfig{}};
  const std::vector<Point> cloud = tests::random_cloud(20000, 3);
  ScanPoints scan;

  read_all(cloud, zones, scan);

  for (std::size_t chunk = 0; chunk < chunk_count(cloud.size()); ++chunk) {
    const ScanRuns::Chunk runs = scan.runs().chunk(chunk);
    for (std::size_t i = 1; i < runs.count; ++i) {
      ASSERT_NE(runs.starts[i] & bin_mask, runs.starts[i - 1] & bin_mask) << "run " << i;
    }
  }
}

TEST_P(ScanPointsOn, CoordinatesAreBitIdenticalToTheCloud) {
  const ConcentricZones zones{PatchworkConfig{}};
  for (const std::size_t size : {1U, 16U, 17U, 8193U}) {
    const std::vector<Point> cloud = tests::corrupted_cloud(size, 4);
    ScanPoints scan;

    read_all(cloud, zones, scan);

    for (std::size_t i = 0; i < size; ++i) {
      ASSERT_EQ(std::bit_cast<std::uint32_t>(scan.x()[i]),
                std::bit_cast<std::uint32_t>(cloud[i].x));
      ASSERT_EQ(std::bit_cast<std::uint32_t>(scan.y()[i]),
                std::bit_cast<std::uint32_t>(cloud[i].y));
      ASSERT_EQ(std::bit_cast<std::uint32_t>(scan.z()[i]),
                std::bit_cast<std::uint32_t>(cloud[i].z));
    }
  }
}

TEST_P(ScanPointsOn, ChunksCanBeReadInAnyOrder) {
  const ConcentricZones zones{PatchworkConfig{}};
  const std::vector<Point> cloud = tests::random_cloud(3 * chunk_size + 5, 5);
  ScanPoints scan;
  scan.reserve(cloud.size());

  for (const std::size_t chunk : {3U, 1U, 0U, 2U}) read_chunk(view_of(cloud), chunk, zones, scan);

  EXPECT_EQ(told_by_runs(scan, cloud.size()), located(cloud, zones));
}

TEST_P(ScanPointsOn, EachRunIsVisitedInInputOrder) {
  const ConcentricZones zones{PatchworkConfig{}};
  const std::vector<Point> cloud = tests::corrupted_cloud(2 * chunk_size + 77, 7);
  ScanPoints scan;
  read_all(cloud, zones, scan);

  std::vector<std::uint32_t> bins;
  const auto add = [&](std::uint32_t bin, std::uint32_t first, std::uint32_t length) {
    EXPECT_EQ(first, bins.size());
    bins.insert(bins.end(), length, bin);
  };
  scan.runs().for_each(chunk_count(cloud.size()), add);

  EXPECT_EQ(bins, located(cloud, zones));
}

TEST(ScanRuns, FewPointsTakeOneChunkAndNoneTakeNone) {
  EXPECT_EQ(chunk_count(0), 0U);
  EXPECT_EQ(chunk_count(1), 1U);
  EXPECT_EQ(chunk_count(chunk_size), 1U);
  EXPECT_EQ(chunk_count(chunk_size + 1), 2U);
}

}  // namespace
}  // namespace flagstone::plane_fits
