// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "flagstone/stage_times.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <numeric>
#include <vector>

#include "flagstone/patchwork.hpp"
#include "flagstone/surface.hpp"
#include "library/surface/outcome.hpp"
#include "random_cloud.hpp"

namespace flagstone {
namespace {

/// One thread or several; the parameter says how many.
class SurfaceStageTimes : public testing::TestWithParam<unsigned> {
 protected:
  std::vector<Point> cloud = tests::random_cloud(60000, 1);
  Surface segmenter{{}, GetParam()};
  StageTimes times{};
};

INSTANTIATE_TEST_SUITE_P(Threads, SurfaceStageTimes, testing::Values(1U, 3U),
                         testing::PrintToStringParamName());

TEST_P(SurfaceStageTimes, AddUpToNoMoreThanTheWholeScanTakes) {
  segmenter.time_stages(&times);
  const auto begin = std::chrono::steady_clock::now();
  tests::segmented(segmenter, tests::view_of(cloud));
  const std::chrono::duration<double> whole = std::chrono::steady_clock::now() - begin;

  const double sum = std::accumulate(times.begin(), times.end(), 0.0);
  EXPECT_GT(sum, 0);
  EXPECT_LE(sum, whole.count());
  for (const double stage : times) EXPECT_GE(stage, 0);
}

TEST_P(SurfaceStageTimes, OfSurfaceAloneAreNotPatchworks) {
  Patchwork patchwork({}, GetParam());
  patchwork.time_stages(&times);
  Segmentation result;
  ASSERT_TRUE(patchwork.segment(tests::view_of(cloud), result).ok());

  for (const Stage stage : {Stage::join, Stage::refine, Stage::measure}) {
    EXPECT_EQ(times.at(static_cast<std::size_t>(stage)), 0) << to_string(stage);
  }
}

TEST_P(SurfaceStageTimes, AreAddedScanAfterScan) {
  segmenter.time_stages(&times);
  tests::segmented(segmenter, tests::view_of(cloud));
  const StageTimes first = times;

  tests::segmented(segmenter, tests::view_of(cloud));

  // Those that the caller always has a part in.
  for (const Stage stage : {Stage::bin, Stage::group, Stage::join, Stage::refine}) {
    const auto i = static_cast<std::size_t>(stage);
    EXPECT_GT(first.at(i), 0);
    EXPECT_GT(times.at(i), first.at(i));
  }
}

TEST_P(SurfaceStageTimes, StopWithNull) {
  segmenter.time_stages(&times);
  tests::segmented(segmenter, tests::view_of(cloud));
  const StageTimes before = times;

  segmenter.time_stages(nullptr);
  tests::segmented(segmenter, tests::view_of(cloud));

  EXPECT_EQ(times, before);
}

TEST_P(SurfaceStageTimes, ChangeNothing) {
  const tests::SurfaceOutcome untimed = tests::segmented(segmenter, tests::view_of(cloud));

  segmenter.time_stages(&times);

  EXPECT_TRUE(tests::is_same(untimed, tests::segmented(segmenter, tests::view_of(cloud))));
}

}  // namespace
}  // namespace flagstone
