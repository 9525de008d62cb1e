// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "files/render/birds_eye.hpp"
#include "files/render/picture.hpp"

namespace flagstone::render {
namespace {

constexpr Color neutral{140, 148, 158};
constexpr Color faint{70, 77, 87};

class BirdsEyeComparison : public PictureTest {
 protected:
  // An image of one point with this label and ground truth.
  Picture draw_one(Label label, Truth truth) {
    LabelledScan scan;
    scan.add(20, 10, 0, label);
    reference_ = {truth};
    options_.reference = reference_;
    return draw(scan);
  }

  std::vector<Truth> reference_;
};

TEST_F(BirdsEyeComparison, ShowsTruePositivesInGreen) {
  EXPECT_GT(draw_one(Label::ground, Truth::ground).count(panel(), green), 0);
}

TEST_F(BirdsEyeComparison, ShowsFalsePositivesInRed) {
  EXPECT_GT(draw_one(Label::ground, Truth::not_ground).count(panel(), red), 0);
}

TEST_F(BirdsEyeComparison, ShowsTrueNegativesInGrey) {
  EXPECT_GT(draw_one(Label::nonground, Truth::not_ground).count(panel(), neutral), 0);
}

TEST_F(BirdsEyeComparison, ShowsGroundWithAnyOtherLabelInBlue) {
  for (const Label label : {Label::nonground, Label::noise, Label::out_of_range})
    EXPECT_GT(draw_one(label, Truth::ground).count(panel(), blue), 0) << to_string(label);
}

TEST_F(BirdsEyeComparison, ShowsIgnoredPointsFaintlyWithAnyLabel) {
  for (const Label label : {Label::nonground, Label::ground, Label::noise})
    EXPECT_GT(draw_one(label, Truth::ignored).count(panel(), faint), 0) << to_string(label);
}

TEST_F(BirdsEyeComparison, DoesNotDrawInvalidPoints) {
  const Picture picture = draw_one(Label::invalid, Truth::ground);

  EXPECT_EQ(picture.count(panel(), blue), 0);
}

TEST_F(BirdsEyeComparison, DrawsErrorsOverCorrectPoints) {
  LabelledScan scan;
  scan.add(20, 10, 0, Label::ground);
  scan.add(20, 10, 0, Label::ground);
  scan.add(20, 10, 0, Label::nonground);
  reference_ = {Truth::not_ground, Truth::ground, Truth::not_ground};
  options_.reference = reference_;

  const Picture picture = draw(scan);

  EXPECT_GT(picture.count(panel(), red), 0);
  EXPECT_EQ(picture.count(panel(), green), 0);
  EXPECT_EQ(picture.count(panel(), neutral), 0);
}

}  // namespace
}  // namespace flagstone::render
