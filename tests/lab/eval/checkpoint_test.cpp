// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/eval/checkpoint.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <string>

#include "files/io/temporary_folder.hpp"

namespace flagstone::eval {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

ScanOutcome outcome_with(double true_positives) {
  MethodOutcome made;
  made.score.points = {true_positives, 2, 3, 4};
  made.score.by_area = {0.125, 0.25, 0.5, 1.0 / 3};
  made.score.by_range[2] = {5, 6, 7, 8};
  made.segment_ms = 1.1;
  made.heights.emplace();
  made.heights->ground.by_range[1] = {
      .points = 7, .given = 6, .median = 1.0 / 3, .percentile95 = 0.5, .bias = -0.25};
  made.heights->everywhere.all.points = 8;
  made.heights->has_common = true;
  made.heights->common_ground.all.points = 9;
  made.heights->common_everywhere.by_range[2].given = 10;
  ScanOutcome outcome;
  outcome.methods = {made, made};
  outcome.read_ms = 0.1;
  outcome.score_ms = 0.2;
  return outcome;
}

class CheckpointFile : public testing::Test {
 protected:
  std::map<std::string, ScanOutcome> resumed(const std::string& evaluation) {
    Checkpoint checkpoint;
    std::map<std::string, ScanOutcome> finished;
    const Status status = checkpoint.resume(file_, evaluation, {.methods = 2}, finished);
    EXPECT_TRUE(status.ok()) << status.message();
    return finished;
  }

  io::TemporaryFolder folder_;
  fs::path file_ = folder_ / "results.json.checkpoint";
};

TEST_F(CheckpointFile, RestoresAddedScansExactly) {
  {
    Checkpoint checkpoint;
    ASSERT_TRUE(checkpoint.start(file_, "one").ok());
    checkpoint.add("05/000001", outcome_with(1));
  }

  const auto finished = resumed("one");

  ASSERT_EQ(finished.count("05/000001"), 1u);
  const ScanOutcome& outcome = finished.at("05/000001");
  ASSERT_EQ(outcome.methods.size(), 2u);
  const Score& score = outcome.methods[0].score;
  EXPECT_EQ(score.points.true_positives, 1);
  EXPECT_EQ(score.by_area.true_negatives, 1.0 / 3);
  EXPECT_EQ(score.by_range[2].false_negatives, 7);
  EXPECT_EQ(outcome.methods[0].segment_ms, 1.1);
  ASSERT_TRUE(outcome.methods[0].heights);
  const HeightErrors& heights = outcome.methods[0].heights->ground.by_range[1];
  EXPECT_EQ(heights.points, 7U);
  EXPECT_EQ(heights.given, 6U);
  EXPECT_EQ(heights.median, 1.0 / 3);
  EXPECT_EQ(heights.percentile95, 0.5);
  EXPECT_EQ(heights.bias, -0.25);
  EXPECT_EQ(outcome.methods[0].heights->everywhere.all.points, 8U);
  EXPECT_TRUE(outcome.methods[0].heights->has_common);
  EXPECT_EQ(outcome.methods[0].heights->common_ground.all.points, 9U);
  EXPECT_EQ(outcome.methods[0].heights->common_everywhere.by_range[2].given, 10U);
}

TEST_F(CheckpointFile, RestoresMovingPointsExactly) {
  ScanOutcome scored = outcome_with(1);
  MovingOutcome& moving = scored.moving.emplace_back();
  moving.score.by_range[1] = {.points = {1, 2, 3, 4}, .obstacles = 5, .kept = 6};
  moving.score.all = moving.score.by_range[1];
  ScanOutcome other_sources = outcome_with(1);
  {
    Checkpoint checkpoint;
    ASSERT_TRUE(checkpoint.start(file_, "one").ok());
    checkpoint.add("05/000001", scored);
    checkpoint.add("05/000002", other_sources);
  }
  Checkpoint checkpoint;
  std::map<std::string, ScanOutcome> finished;

  const Status status = checkpoint.resume(file_, "one", {.methods = 2, .moving = 1}, finished);

  ASSERT_TRUE(status.ok()) << status.message();
  ASSERT_EQ(finished.size(), 1U) << "a scan with other sources is evaluated again";
  const MovingScore& score = finished.at("05/000001").moving.at(0).score;
  EXPECT_EQ(score.by_range[1].points.true_positives, 1);
  EXPECT_EQ(score.by_range[1].points.true_negatives, 4);
  EXPECT_EQ(score.by_range[1].obstacles, 5);
  EXPECT_EQ(score.by_range[1].kept, 6);
  EXPECT_EQ(score.all.points.false_negatives, 3);
  EXPECT_EQ(score.all.kept, 6);
}

TEST_F(CheckpointFile, OmitsScansWithFailedMovingPoints) {
  ScanOutcome failed = outcome_with(1);
  failed.moving.emplace_back().error = "moving points map: no such file";
  {
    Checkpoint checkpoint;
    ASSERT_TRUE(checkpoint.start(file_, "one").ok());
    checkpoint.add("05/000001", failed);
  }
  Checkpoint checkpoint;
  std::map<std::string, ScanOutcome> finished;

  ASSERT_TRUE(checkpoint.resume(file_, "one", {.methods = 2, .moving = 1}, finished).ok());

  EXPECT_TRUE(finished.empty());
}

TEST_F(CheckpointFile, RestoresScansWithoutHeights) {
  ScanOutcome without = outcome_with(1);
  for (MethodOutcome& method : without.methods) method.heights.reset();
  {
    Checkpoint checkpoint;
    ASSERT_TRUE(checkpoint.start(file_, "one").ok());
    checkpoint.add("a", without);
  }

  EXPECT_FALSE(resumed("one").at("a").methods[0].heights);
}

TEST_F(CheckpointFile, ATruncatedLineLosesOnlyItsScan) {
  {
    Checkpoint checkpoint;
    ASSERT_TRUE(checkpoint.start(file_, "one").ok());
    checkpoint.add("a", outcome_with(1));
    checkpoint.add("b", outcome_with(2));
  }
  fs::resize_file(file_, fs::file_size(file_) - 9);

  EXPECT_EQ(resumed("one").count("b"), 0u);

  {
    Checkpoint checkpoint;
    std::map<std::string, ScanOutcome> finished;
    ASSERT_TRUE(checkpoint.resume(file_, "one", {.methods = 2}, finished).ok());
    checkpoint.add("c", outcome_with(3));
  }
  const auto finished = resumed("one");
  EXPECT_EQ(finished.count("a"), 1u);
  EXPECT_EQ(finished.count("c"), 1u);
}

TEST_F(CheckpointFile, RejectsTheCheckpointOfAnotherEvaluation) {
  ASSERT_TRUE(Checkpoint().start(file_, "one").ok());
  Checkpoint checkpoint;
  std::map<std::string, ScanOutcome> finished;

  const Status status = checkpoint.resume(file_, "two", {.methods = 2}, finished);

  EXPECT_EQ(status.code(), StatusCode::invalid_argument);
  EXPECT_THAT(status.message(), HasSubstr("delete the file"));
}

TEST_F(CheckpointFile, RejectsAndKeepsAnyOtherFile) {
  std::ofstream(file_) << "precious\n";
  Checkpoint checkpoint;
  std::map<std::string, ScanOutcome> finished;

  EXPECT_EQ(checkpoint.resume(file_, "one", {.methods = 2}, finished).code(), StatusCode::bad_file);
  EXPECT_EQ(fs::file_size(file_), 9u);
}

TEST_F(CheckpointFile, DoesNotOverwriteTheScansOfAnInterruptedRun) {
  {
    Checkpoint checkpoint;
    ASSERT_TRUE(checkpoint.start(file_, "one").ok());
    checkpoint.add("a", outcome_with(1));
  }

  const Status status = Checkpoint().start(file_, "one");

  EXPECT_EQ(status.code(), StatusCode::invalid_argument);
  EXPECT_THAT(status.message(), HasSubstr("--resume"));
  EXPECT_EQ(resumed("one").count("a"), 1u);
}

TEST_F(CheckpointFile, OverwritesACheckpointWithoutScans) {
  ASSERT_TRUE(Checkpoint().start(file_, "one").ok());

  EXPECT_TRUE(Checkpoint().start(file_, "two").ok());
}

TEST_F(CheckpointFile, SkipsScansWithADifferentNumberOfMethods) {
  {
    Checkpoint checkpoint;
    ASSERT_TRUE(checkpoint.start(file_, "one").ok());
    ScanOutcome outcome = outcome_with(1);
    outcome.methods.clear();
    checkpoint.add("a", outcome);
  }

  EXPECT_TRUE(resumed("one").empty());
}

TEST_F(CheckpointFile, SkipsScansOnWhichAMethodFailed) {
  {
    Checkpoint checkpoint;
    ASSERT_TRUE(checkpoint.start(file_, "one").ok());
    ScanOutcome outcome = outcome_with(1);
    outcome.methods[1].error = "a: labels are missing";
    checkpoint.add("a", outcome);
  }

  EXPECT_TRUE(resumed("one").empty());
}

TEST_F(CheckpointFile, SkipsScansThatCouldNotBeRead) {
  {
    Checkpoint checkpoint;
    ASSERT_TRUE(checkpoint.start(file_, "one").ok());
    ScanOutcome failed;
    failed.error = "a: gone";
    checkpoint.add("a", failed);
  }

  EXPECT_TRUE(resumed("one").empty());
}

}  // namespace
}  // namespace flagstone::eval
