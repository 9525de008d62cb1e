// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/bench/benchmark.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "flagstone/segmentation.hpp"
#include "library/core/simd_target.hpp"
#include "random_cloud.hpp"

namespace flagstone::bench {
namespace {

using testing::ElementsAre;

io::Cloud cloud_of(std::size_t points, std::uint32_t seed) {
  std::vector<float> rows;
  for (const Point& p : tests::random_cloud(points, seed)) {
    rows.insert(rows.end(), {p.x, p.y, p.z, 0.5f});
  }
  io::Cloud cloud;
  EXPECT_TRUE(io::Cloud::from_floats(rows, 4, cloud).ok());
  return cloud;
}

const BenchmarkWatch no_watch = {.progress = [](auto, auto) {}, .stop = [] { return false; }};

/// Records the scans it was run on. The time of each trial is its number.
class RecordingCandidate final : public Candidate {
 public:
  explicit RecordingCandidate(std::size_t untimed_passes) : untimed_passes_(untimed_passes) {}

  Trial run_trial(std::size_t scan) override {
    scans.push_back(scan);
    return {.milliseconds = static_cast<double>(scans.size() - 1)};
  }
  [[nodiscard]] std::size_t untimed_passes() const noexcept override { return untimed_passes_; }

  std::vector<std::size_t> scans;

 private:
  std::size_t untimed_passes_;
};

/// The numbers of the trials that run_passes() notes for three scans.
std::vector<double> noted_trials(RecordingCandidate& candidate) {
  std::vector<double> noted;
  run_passes(
      candidate, 3,
      [&](std::size_t scan, const Trial& trial) {
        EXPECT_EQ(candidate.scans.back(), scan);
        noted.push_back(trial.milliseconds);
      },
      [] { return false; });
  return noted;
}

TEST(Passes, OnlyThePassAfterTheUntimedOnesIsNoted) {
  RecordingCandidate candidate(1);

  EXPECT_THAT(noted_trials(candidate), ElementsAre(3, 4, 5));

  EXPECT_THAT(candidate.scans, ElementsAre(0, 1, 2, 0, 1, 2));
}

TEST(Passes, WithoutUntimedPassesEveryTrialIsNoted) {
  RecordingCandidate candidate(0);

  EXPECT_THAT(noted_trials(candidate), ElementsAre(0, 1, 2));
}

TEST(Passes, EndWhenStopped) {
  RecordingCandidate candidate(1);
  const auto no_note = [](std::size_t, const Trial&) { ADD_FAILURE() << "untimed pass noted"; };

  run_passes(candidate, 3, no_note, [&] { return candidate.scans.size() == 2; });

  EXPECT_THAT(candidate.scans, ElementsAre(0, 1));
}

TEST(Passes, OnlyTheReadBaselineHasAnUntimedPass) {
  const io::Cloud cloud = cloud_of(100, 1);
  const std::vector<CloudView> scans = {cloud.view()};

  EXPECT_EQ(TimedReadBaseline(scans, "").untimed_passes(), 1U);
  EXPECT_EQ(TimedSegment(scans, SurfaceConfig{}, {}, 1, "").untimed_passes(), 0U);
}

TEST(Benchmark, TimesEveryCandidateOnEveryScanOfEveryRound) {
  const std::vector<io::Cloud> scans = {cloud_of(2000, 1), cloud_of(3000, 2), cloud_of(1000, 3)};

  const Results results = run_benchmark(scans, {.rounds = 4}, no_watch);

  EXPECT_EQ(results.rounds, 4U);
  EXPECT_THAT(results.points, ElementsAre(2000, 3000, 1000));
  for (const Measured* measured : {&results.segment, &results.floor, &results.scalar}) {
    EXPECT_EQ(measured->times.count(), 12U);
    EXPECT_GT(measured->times.median(), 0);
  }
  for (const StageResult& stage : results.stages) EXPECT_EQ(stage.times.count(), 12U);
  EXPECT_TRUE(results.external_tools.empty());
}

class BenchmarkOf : public testing::TestWithParam<std::string_view> {
 protected:
  static TimedConfig config() {
    if (GetParam() == "surface") return SurfaceConfig{};
    return PatchworkConfig{};
  }
};

INSTANTIATE_TEST_SUITE_P(Methods, BenchmarkOf, testing::ValuesIn(timed_methods),
                         [](const auto& method) { return std::string(method.param); });

TEST_P(BenchmarkOf, TimesEveryStageOfTheMethod) {
  const std::vector<io::Cloud> scans = {cloud_of(5000, 1)};

  const Results results = run_benchmark(scans, {.config = config(), .rounds = 3}, no_watch);

  EXPECT_EQ(results.method, GetParam());
  for (const StageResult& stage : results.stages) {
    EXPECT_EQ(stage.times.count(), 3U) << to_string(stage.stage);
    EXPECT_GT(stage.times.median(), 0) << to_string(stage.stage);
  }
}

TEST_P(BenchmarkOf, FindsTheSameGroundWithEveryInstructionSet) {
  const std::vector<io::Cloud> scans = {cloud_of(4000, 1), cloud_of(3000, 2)};
  Segmentation expected;
  std::vector<std::optional<std::size_t>> ground;
  const auto segmenter = make_timed(config(), {}, 1, nullptr);
  for (const io::Cloud& scan : scans) {
    ASSERT_TRUE(segmenter->segment(scan.view(), expected).ok());
    ground.emplace_back(expected.count(Label::ground));
  }

  for (const std::string& target : simd_targets()) {
    const Results results =
        run_benchmark(scans, {.config = config(), .target = target, .rounds = 1}, no_watch);

    EXPECT_EQ(results.target, target);
    EXPECT_EQ(results.segment.ground, ground);
    EXPECT_EQ(results.scalar.ground, ground);
  }
}

TEST(Benchmark, RestoresTheBestInstructionSet) {
  const std::string best = simd_target();
  const std::vector<io::Cloud> scans = {cloud_of(100, 1)};

  static_cast<void>(run_benchmark(scans, {.target = "scalar", .rounds = 1}, no_watch));

  EXPECT_EQ(simd_target(), best);
}

TEST(Benchmark, RejectsInvalidSettings) {
  const std::vector<io::Cloud> scans = {cloud_of(100, 1)};

  EXPECT_THROW(static_cast<void>(run_benchmark(scans, {.target = "abacus"}, no_watch)),
               std::invalid_argument);
  EXPECT_THROW(static_cast<void>(run_benchmark(
                   scans, {.config = PatchworkConfig{.distance_margin = -1}}, no_watch)),
               std::invalid_argument);
  EXPECT_THROW(
      static_cast<void>(run_benchmark(scans, {.config = SurfaceConfig{.max_range = -1}}, no_watch)),
      std::invalid_argument);
}

TEST(Benchmark, StoppedInItsThirdRoundReturnsTheTimesSoFar) {
  const std::vector<io::Cloud> scans = {cloud_of(500, 1), cloud_of(500, 2)};
  std::size_t begun = 0;
  const BenchmarkWatch watch = {.progress = [&](std::size_t, std::size_t) { ++begun; },
                                .stop = [&] { return begun == 3; }};

  const Results results = run_benchmark(scans, {.rounds = 1000}, watch);

  EXPECT_EQ(results.rounds, 3U);
  EXPECT_EQ(results.segment.times.count(), 4U);
  EXPECT_GT(results.segment.times.median(), 0);
}

}  // namespace
}  // namespace flagstone::bench
