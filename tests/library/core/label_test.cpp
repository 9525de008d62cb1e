// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "flagstone/label.hpp"

#include <gtest/gtest.h>

#include <set>
#include <string>
#include <utility>

#include "flagstone/patch.hpp"
#include "flagstone/segmentation.hpp"
#include "flagstone/stage_times.hpp"
#include "flagstone/status.hpp"

namespace flagstone {
namespace {

TEST(Label, HasTheDocumentedCodes) {
  EXPECT_EQ(static_cast<int>(Label::nonground), 0);
  EXPECT_EQ(static_cast<int>(Label::ground), 1);
  EXPECT_EQ(static_cast<int>(Label::noise), 2);
  EXPECT_EQ(static_cast<int>(Label::out_of_range), 3);
  EXPECT_EQ(static_cast<int>(Label::invalid), 4);
  EXPECT_EQ(sizeof(Label), 1u);
}

TEST(Label, HasTheDocumentedNames) {
  EXPECT_STREQ(to_string(Label::nonground), "nonground");
  EXPECT_STREQ(to_string(Label::ground), "ground");
  EXPECT_STREQ(to_string(Label::noise), "noise");
  EXPECT_STREQ(to_string(Label::out_of_range), "out_of_range");
  EXPECT_STREQ(to_string(Label::invalid), "invalid");
}

TEST(Verdict, HasTheNamesOfTheEnumeration) {
  EXPECT_STREQ(to_string(Verdict::ground), "ground");
  EXPECT_STREQ(to_string(Verdict::ground_flat), "ground_flat");
  EXPECT_STREQ(to_string(Verdict::too_few_points), "too_few_points");
  EXPECT_STREQ(to_string(Verdict::no_plane), "no_plane");
  EXPECT_STREQ(to_string(Verdict::not_upright), "not_upright");
  EXPECT_STREQ(to_string(Verdict::too_high), "too_high");
  EXPECT_STREQ(to_string(Verdict::mixed), "mixed");
  EXPECT_STREQ(to_string(Verdict::off_surface), "off_surface");
}

TEST(Verdict, MixedAndOffSurfaceAreNotGround) {
  EXPECT_FALSE(Patch{.verdict = Verdict::mixed}.is_ground());
  EXPECT_FALSE(Patch{.verdict = Verdict::off_surface}.is_ground());
  EXPECT_TRUE(Patch{.verdict = Verdict::ground}.is_ground());
}

TEST(Stage, EveryStageHasAUniqueName) {
  std::set<std::string> names;
  for (std::size_t stage = 0; stage < stage_count; ++stage) {
    names.insert(to_string(static_cast<Stage>(stage)));
  }

  EXPECT_EQ(names.size(), stage_count);
  EXPECT_FALSE(names.contains("unknown"));
  EXPECT_STREQ(to_string(static_cast<Stage>(stage_count)), "unknown");
}

TEST(Segmentation, CountsAddUpToTheNumberOfPoints) {
  Segmentation result;
  const std::span<Label> labels = result.start(5);
  labels[1] = Label::ground;
  labels[2] = Label::ground;
  labels[4] = Label::noise;

  result.finish();

  EXPECT_EQ(result.count(Label::nonground), 2u);
  EXPECT_EQ(result.count(Label::ground), 2u);
  EXPECT_EQ(result.count(Label::noise), 1u);
}

TEST(Segmentation, StartClearsThePreviousResult) {
  Segmentation result;
  result.start(3)[0] = Label::ground;
  result.mutable_patches().emplace_back();
  result.finish();

  result.start(2);
  result.finish();

  EXPECT_EQ(result.labels().size(), 2u);
  EXPECT_EQ(result.count(Label::ground), 0u);
  EXPECT_TRUE(result.patches().empty());
}

TEST(Segmentation, HasNoHeightsAfterMoveAndCanBeFilledAgain) {
  Segmentation result;
  result.start(3);
  result.start_heights()[0] = 1;
  const Segmentation taken = std::move(result);

  EXPECT_EQ(taken.heights().size(), 3u);
  EXPECT_TRUE(result.heights().empty());  // NOLINT(bugprone-use-after-move): this is tested
  result.start(2);
  EXPECT_EQ(result.start_heights().size(), 2u);
  EXPECT_EQ(result.heights().size(), 2u);
}

TEST(Status, IsOkUnlessItHasAnErrorCode) {
  EXPECT_TRUE(Status().ok());

  const Status status(StatusCode::bad_file, "scan.bin: byte 12: ends early");

  EXPECT_FALSE(status.ok());
  EXPECT_EQ(status.code(), StatusCode::bad_file);
  EXPECT_EQ(status.message(), "scan.bin: byte 12: ends early");
}

}  // namespace
}  // namespace flagstone
