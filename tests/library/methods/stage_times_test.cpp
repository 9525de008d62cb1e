// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "flagstone/stage_times.hpp"

#include <chrono>
#include <numeric>

#include "library/methods/methods.hpp"
#include "random_cloud.hpp"

namespace flagstone {
namespace {

/// The stages in which the calling thread always does some of the work.
template <class Method>
std::vector<Stage> stages_of_the_caller() {
  if constexpr (std::is_same_v<Method, Surface>) {
    return {Stage::bin, Stage::group, Stage::join, Stage::refine};
  } else {
    return {Stage::bin, Stage::group};
  }
}

/// A method with one thread and with several threads.
template <class Method>
class StageTimesOf : public testing::Test {
 protected:
  void segment(Method& method) const { tests::segmented(method, tests::view_of(cloud)); }

  const std::vector<Point> cloud = tests::random_cloud(60000, 1);
  Method methods[2] = {Method({}, 1), Method({}, 3)};
  StageTimes times{};  // of all scans
};

TYPED_TEST_SUITE(StageTimesOf, tests::LibraryMethods);

TYPED_TEST(StageTimesOf, AddUpToAtMostTheTimeOfTheScan) {
  for (TypeParam& method : this->methods) {
    StageTimes sums{};
    method.time_stages(&sums);
    const auto begin = std::chrono::steady_clock::now();
    this->segment(method);
    const std::chrono::duration<double> whole = std::chrono::steady_clock::now() - begin;

    const double sum = std::accumulate(sums.begin(), sums.end(), 0.0);
    EXPECT_GT(sum, 0);
    EXPECT_LE(sum, whole.count());
    for (const double stage : sums) EXPECT_GE(stage, 0);
  }
}

TYPED_TEST(StageTimesOf, AccumulateOverScans) {
  for (TypeParam& method : this->methods) {
    StageTimes sums{};
    method.time_stages(&sums);
    this->segment(method);
    const StageTimes first = sums;

    this->segment(method);

    for (const Stage stage : stages_of_the_caller<TypeParam>()) {
      const auto i = static_cast<std::size_t>(stage);
      EXPECT_GT(first.at(i), 0);
      EXPECT_GT(sums.at(i), first.at(i));
    }
  }
}

TYPED_TEST(StageTimesOf, AreNotMeasuredAfterNull) {
  for (TypeParam& method : this->methods) {
    method.time_stages(&this->times);
    this->segment(method);
    const StageTimes before = this->times;

    method.time_stages(nullptr);
    this->segment(method);

    EXPECT_EQ(this->times, before);
  }
}

TYPED_TEST(StageTimesOf, DoNotChangeTheResult) {
  for (TypeParam& method : this->methods) {
    const tests::Outcome untimed = tests::segmented(method, tests::view_of(this->cloud));

    method.time_stages(&this->times);

    EXPECT_TRUE(tests::is_same(untimed, tests::segmented(method, tests::view_of(this->cloud))));
  }
}

TEST(StageTimesOfPatchwork, AreZeroForTheStagesOfSurface) {
  for (const unsigned threads : {1U, 3U}) {
    StageTimes times{};
    Patchwork patchwork({}, threads);
    patchwork.time_stages(&times);
    tests::segmented(patchwork, tests::view_of(tests::random_cloud(60000, 1)));

    for (const Stage stage : {Stage::join, Stage::refine, Stage::measure}) {
      EXPECT_EQ(times.at(static_cast<std::size_t>(stage)), 0) << to_string(stage);
    }
  }
}

}  // namespace
}  // namespace flagstone
