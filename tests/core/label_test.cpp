// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "flagstone/label.hpp"

#include <gtest/gtest.h>

#include "flagstone/segmentation.hpp"
#include "flagstone/status.hpp"

namespace flagstone {
namespace {

TEST(Label, CodesAreThoseOfTheDataContract) {
  EXPECT_EQ(static_cast<int>(Label::nonground), 0);
  EXPECT_EQ(static_cast<int>(Label::ground), 1);
  EXPECT_EQ(static_cast<int>(Label::noise), 2);
  EXPECT_EQ(static_cast<int>(Label::out_of_range), 3);
  EXPECT_EQ(static_cast<int>(Label::invalid), 4);
  EXPECT_EQ(sizeof(Label), 1u);
}

TEST(Label, NamesAreThoseOfTheDataContract) {
  EXPECT_STREQ(to_string(Label::nonground), "nonground");
  EXPECT_STREQ(to_string(Label::ground), "ground");
  EXPECT_STREQ(to_string(Label::noise), "noise");
  EXPECT_STREQ(to_string(Label::out_of_range), "out_of_range");
  EXPECT_STREQ(to_string(Label::invalid), "invalid");
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

TEST(Segmentation, StartForgetsWhatWasThere) {
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

TEST(Status, IsOkUnlessItSaysWhatIsWrong) {
  EXPECT_TRUE(Status().ok());

  const Status status(StatusCode::bad_file, "scan.bin: byte 12: ends early");

  EXPECT_FALSE(status.ok());
  EXPECT_EQ(status.code(), StatusCode::bad_file);
  EXPECT_EQ(status.message(), "scan.bin: byte 12: ends early");
}

}  // namespace
}  // namespace flagstone
