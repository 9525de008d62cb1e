// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "files/render/birds_eye.hpp"

#include <gmock/gmock.h>
#include <rapidcheck/gtest.h>

#include <bit>
#include <limits>
#include <thread>

#include "files/render/picture.hpp"

namespace flagstone::render {
namespace {

constexpr Color yellow{246, 201, 58};
constexpr Color cyan{58, 196, 226};

class BirdsEyeImage : public PictureTest {};

TEST_F(BirdsEyeImage, IsAValidPngOfTheRequestedSize) {
  options_.width = 700;
  options_.height = 640;

  const Picture picture = draw({});

  EXPECT_EQ(picture.width(), 700);
  EXPECT_EQ(picture.height(), 640);
}

TEST_F(BirdsEyeImage, ShowsGroundAheadOfTheSensorYellowInTheUpperHalf) {
  LabelledScan scan;
  scan.add(20, 0, -1.7f, Label::ground);

  const Picture::Place place = draw(scan).place(panel(), yellow);

  EXPECT_NEAR(place.column, panel().center_x(), 1);
  EXPECT_NEAR(place.row, panel().y + panel().height / 4, 1);
}

TEST_F(BirdsEyeImage, ShowsNonGroundToTheLeftOfTheSensorCyanOnTheLeft) {
  LabelledScan scan;
  scan.add(0, 20, 0, Label::nonground);

  const Picture::Place place = draw(scan).place(panel(), cyan);

  EXPECT_NEAR(place.column, panel().x + panel().width / 4, 2);
  EXPECT_NEAR(place.row, panel().center_y(), 1);
}

TEST_F(BirdsEyeImage, DrawsObjectsOverTheGround) {
  LabelledScan scan;
  scan.add(10, 5, 0, Label::nonground);
  scan.add(10, 5, -1.7f, Label::ground);

  const Picture picture = draw(scan);

  EXPECT_GT(picture.count(panel(), cyan), 0);
  EXPECT_EQ(picture.count(panel(), yellow), 0);
}

TEST_F(BirdsEyeImage, UsesADifferentColourForEachDrawnLabel) {
  std::vector<std::vector<Color>> panels;
  for (const Label label : {Label::nonground, Label::ground, Label::noise, Label::out_of_range}) {
    LabelledScan scan;
    scan.add(10, 5, 0, label);
    panels.push_back(draw(scan).cut(panel()));
  }

  for (std::size_t i = 0; i < panels.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) EXPECT_NE(panels[i], panels[j]) << i << " and " << j;
}

TEST_F(BirdsEyeImage, CountsButDoesNotDrawInvalidPoints) {
  LabelledScan scan;
  scan.add(10, 5, 0, Label::invalid);

  const Picture without = draw({});
  const Picture with = draw(scan);

  EXPECT_EQ(with.cut(panel()), without.cut(panel()));
  const Rectangle legend{0, panel().bottom(), with.width() * 1.0, with.height() - panel().bottom()};
  EXPECT_NE(with.cut(legend), without.cut(legend));
}

TEST_F(BirdsEyeImage, NotesPointsOutsideTheView) {
  LabelledScan inside;
  LabelledScan outside;
  inside.add(10, 0, 0, Label::invalid);
  outside.add(1e4f, 0, 0, Label::ground);

  EXPECT_NE(draw(outside).cut(panel()), draw(inside).cut(panel()));
}

TEST_F(BirdsEyeImage, DrawsNoPointsInTheMargins) {
  LabelledScan scan;
  for (const float along : {-40.0f, -20.0f, 0.0f, 20.0f, 40.0f})
    for (const float edge : {-39.99f, 39.99f}) {
      scan.add(edge, along, 0, Label::ground);
      scan.add(along, edge, 0, Label::ground);
    }

  const Picture picture = draw(scan);

  const Rectangle left{0, panel().y, panel().x, panel().height};
  const Rectangle right{panel().right(), panel().y, picture.width() - panel().right(),
                        panel().height};
  EXPECT_EQ(picture.count(left, page_color), left.width * left.height);
  EXPECT_EQ(picture.count(right, page_color), right.width * right.height);
}

TEST_F(BirdsEyeImage, AcceptsAnEmptyCloud) {
  options_.range = 0;

  const Picture picture = draw({});

  EXPECT_GT(picture.count(panel(), panel_color), 0);
  EXPECT_EQ(picture.count(panel(), yellow), 0);
}

TEST_F(BirdsEyeImage, AcceptsAnyCoordinates) {
  constexpr float infinity = std::numeric_limits<float>::infinity();
  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  options_.range = 0;
  LabelledScan scan;
  for (const float wild : {nan, infinity, -infinity, 1e38f, -1e38f, 1e-45f, 0.0f})
    for (const Label label : {Label::ground, Label::nonground, Label::invalid}) {
      scan.add(wild, 0, 0, label);
      scan.add(0, wild, 0, label);
      scan.add(wild, wild, wild, label);
    }

  EXPECT_EQ(draw(scan).width(), options_.width);
}

RC_GTEST_FIXTURE_PROP(BirdsEyeImage, AcceptsAnyBitPatternAsCoordinates, ()) {
  options_.width = options_.height = 320;
  options_.range = 0;
  LabelledScan scan;
  for (const auto& [x, y, label] :
       *rc::gen::container<std::vector<std::tuple<std::uint32_t, std::uint32_t, int>>>(
           rc::gen::tuple(rc::gen::arbitrary<std::uint32_t>(), rc::gen::arbitrary<std::uint32_t>(),
                          rc::gen::inRange(0, static_cast<int>(label_count)))))
    scan.add(std::bit_cast<float>(x), std::bit_cast<float>(y), 0, static_cast<Label>(label));

  RC_ASSERT(draw_birds_eye(png_, scan.cloud(), scan.result, options_).ok());
  RC_ASSERT(Picture(png_).width() == 320);
}

TEST_F(BirdsEyeImage, IsDeterministic) {
  LabelledScan scan;
  scan.add(10, 5, 0, Label::ground);
  options_.title = "scan.bin";
  draw(scan);
  const std::string first = bytes_of(png_);

  draw(scan);

  EXPECT_EQ(bytes_of(png_), first);
}

TEST_F(BirdsEyeImage, IsBitIdenticalOnEveryThread) {
  LabelledScan scan;
  scan.add(10, 5, 0, Label::ground);
  options_.title = "scan.bin";
  draw(scan);

  const auto path = [this](int i) { return folder_ / (std::to_string(i) + ".png"); };
  std::vector<std::jthread> threads;
  threads.reserve(4);
  for (int i = 0; i < 4; ++i)
    threads.emplace_back(
        [&, i] { EXPECT_TRUE(draw_birds_eye(path(i), scan.cloud(), scan.result, options_).ok()); });
  threads.clear();

  for (int i = 0; i < 4; ++i) EXPECT_EQ(bytes_of(path(i)), bytes_of(png_));
}

TEST_F(BirdsEyeImage, LeavesNoOtherFile) {
  draw({});

  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder_)) files.push_back(entry);
  EXPECT_THAT(files, testing::ElementsAre(png_));
}

}  // namespace
}  // namespace flagstone::render
