// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "flagstone/stage_times.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <numeric>
#include <vector>

#include "flagstone/patchwork.hpp"
#include "library/patchwork/outcome.hpp"
#include "random_cloud.hpp"

namespace flagstone {
namespace {

/// One thread or several; the parameter says how many.
class StageTimesWith : public testing::TestWithParam<unsigned> {
 protected:
  std::vector<Point> cloud = tests::random_cloud(60000, 1);
  Patchwork patchwork{{}, GetParam()};
  StageTimes times{};
};

INSTANTIATE_TEST_SUITE_P(Threads, StageTimesWith, testing::Values(1U, 3U),
                         testing::PrintToStringParamName());

TEST_P(StageTimesWith, AddUpToNoMoreThanTheWholeScanTakes) {
  patchwork.time_stages(&times);
  const auto begin = std::chrono::steady_clock::now();
  tests::segmented(patchwork, tests::view_of(cloud));
  const std::chrono::duration<double> whole = std::chrono::steady_clock::now() - begin;

  const double sum = std::accumulate(times.begin(), times.end(), 0.0);
  EXPECT_GT(sum, 0);
  EXPECT_LE(sum, whole.count());
  for (const double stage : times) EXPECT_GE(stage, 0);
}

TEST_P(StageTimesWith, AreAddedScanAfterScan) {
  patchwork.time_stages(&times);
  tests::segmented(patchwork, tests::view_of(cloud));
  const StageTimes first = times;

  tests::segmented(patchwork, tests::view_of(cloud));

  for (const Stage stage : {Stage::bin, Stage::group}) {  // which the caller always has a part in
    const auto i = static_cast<std::size_t>(stage);
    EXPECT_GT(first.at(i), 0);
    EXPECT_GT(times.at(i), first.at(i));
  }
}

TEST_P(StageTimesWith, StopWithNull) {
  patchwork.time_stages(&times);
  tests::segmented(patchwork, tests::view_of(cloud));
  const StageTimes before = times;

  patchwork.time_stages(nullptr);
  tests::segmented(patchwork, tests::view_of(cloud));

  EXPECT_EQ(times, before);
}

TEST_P(StageTimesWith, ChangeNoLabel) {
  const tests::Outcome untimed = tests::segmented(patchwork, tests::view_of(cloud));

  patchwork.time_stages(&times);

  EXPECT_TRUE(tests::is_same(untimed, tests::segmented(patchwork, tests::view_of(cloud))));
}

}  // namespace
}  // namespace flagstone
