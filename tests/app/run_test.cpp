// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "app/run.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <numeric>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace flagstone::app {
namespace {

using testing::EndsWith;

std::string text(std::size_t done, std::size_t total, double seconds_left,
                 std::size_t columns = 200) {
  return to_text({.done = done, .total = total, .seconds_left = seconds_left}, columns);
}

TEST(Progress, BarGrowsWithTheFractionDone) {
  EXPECT_EQ(to_text({.done = 0, .total = 4}, 80), "[                              ] 0 of 4 scans");
  EXPECT_EQ(text(1, 2, 5), "[###############               ] 1 of 2 scans, 5 s left");
  EXPECT_EQ(text(4, 4, 0), "[##############################] 4 of 4 scans");
  EXPECT_EQ(to_text({.done = 1, .total = 2, .unit = "frames"}, 80),
            "[###############               ] 1 of 2 frames");
}

TEST(Progress, TimeLeftHasAtMostTwoUnits) {
  EXPECT_THAT(text(40, 100, 12), EndsWith(" 40 of 100 scans, 12 s left"));
  EXPECT_THAT(text(1, 11, 125), EndsWith(", 2 min 05 s left"));
  EXPECT_THAT(text(1, 3601, 7200), EndsWith(", 2 h 00 min left"));
}

TEST(Progress, BarIsFullWithNothingToDo) {
  EXPECT_EQ(text(0, 0, 0), "[##############################] 0 of 0 scans");
}

TEST(Progress, TextIsNeverWiderThanTheTerminal) {
  for (std::size_t columns = 0; columns < 120; ++columns) {
    EXPECT_LE(text(12345, 99999, 4000, columns).size(), columns);
  }
  EXPECT_EQ(text(40, 100, 12, 40), "[####       ] 40 of 100 scans, 12 s left");
  EXPECT_EQ(text(40, 100, 12, 30), "40 of 100 scans, 12 s left");
  EXPECT_EQ(text(40, 100, 12, 10), "40 of 100 ");
}

TEST(Progress, TimeLeftAssumesTheSameTimePerJob) {
  const ProgressMeter meter(10);
  std::this_thread::sleep_for(std::chrono::milliseconds(20));

  EXPECT_FALSE(meter.at(0).seconds_left.has_value());
  EXPECT_GE(meter.at(2).seconds_left.value_or(0), 4 * 0.02);
  EXPECT_EQ(meter.at(10).seconds_left.value_or(1), 0);
}

TEST(Progress, TimeLeftOfAResumedRunAssumesTheTimeOfTheJobsSinceThen) {
  const ProgressMeter meter(10, "scans", 8);
  std::this_thread::sleep_for(std::chrono::milliseconds(20));

  EXPECT_FALSE(meter.at(8).seconds_left.has_value());
  EXPECT_GE(meter.at(9).seconds_left.value_or(0), 0.02);
}

/// The jobs in the order of their reports.
std::vector<std::size_t> delivered(std::size_t count, unsigned threads,
                                   const RunCallbacks& callbacks = {}) {
  std::vector<std::size_t> jobs;
  run_in_order(
      count, threads, "scans", callbacks,
      [] {
        return [](std::size_t job) {
          if (job % 7 == 0) std::this_thread::sleep_for(std::chrono::milliseconds(1));
          return 10 * job;
        };
      },
      [&](std::size_t job, std::size_t report) {
        EXPECT_EQ(report, 10 * job);
        jobs.push_back(job);
      });
  return jobs;
}

TEST(RunInOrder, DeliversReportsInTheOrderOfTheJobs) {
  std::vector<std::size_t> all(500);
  std::iota(all.begin(), all.end(), std::size_t{0});

  EXPECT_EQ(delivered(500, 1), all);
  EXPECT_EQ(delivered(500, 4), all);
  EXPECT_TRUE(delivered(0, 4).empty());
}

TEST(RunInOrder, ProgressStartsAtZeroAndEndsAtAll) {
  std::vector<std::size_t> done;
  delivered(50, 2, {.progress = [&](const Progress& at) {
              EXPECT_EQ(at.total, 50U);
              done.push_back(at.done);
            }});

  EXPECT_EQ(done.front(), 0U);
  EXPECT_EQ(done.back(), 50U);
  EXPECT_TRUE(std::ranges::is_sorted(done));
}

TEST(RunInOrder, DeliversFinishedJobsWhenStopped) {
  std::atomic<int> asked = 0;
  const std::vector<std::size_t> jobs = delivered(1000, 2, {.stop = [&] { return ++asked > 20; }});

  EXPECT_GT(jobs.size(), 0U);
  EXPECT_LT(jobs.size(), 30U);
  EXPECT_TRUE(std::ranges::is_sorted(jobs));
}

TEST(RunInOrder, RethrowsTheExceptionOfAJob) {
  const auto run = [](unsigned threads) {
    run_in_order(
        100, threads, "scans", {},
        [] {
          return [](std::size_t job) {
            if (job == 50) throw std::runtime_error("broken");
            return job;
          };
        },
        [](std::size_t, std::size_t) {});
  };

  EXPECT_THROW(run(1), std::runtime_error);
  EXPECT_THROW(run(3), std::runtime_error);
}

}  // namespace
}  // namespace flagstone::app
