// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "files/render/side_by_side.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <fstream>
#include <limits>

#include "files/render/canvas.hpp"
#include "files/render/picture.hpp"

namespace flagstone::render {
namespace {

using testing::HasSubstr;

// Images of one ground point at x = 20 m, y = 10 m.
class SideBySideImage : public PictureTest {
 protected:
  SideBySideImage() {
    scan_.add(20, 10, 0, Label::ground);
    side_by_side_.range = 40;
    side_by_side_.width = 900;
  }

  void add_panel(std::span<const Label> labels) {
    panels_.push_back({.title = "RANSAC", .subtitle = "F1 93.10 %", .labels = labels});
  }

  Status render() {
    return render_side_by_side(scan_.cloud(), truth_, panels_, side_by_side_, bytes_);
  }

  // Renders, expects success and reads the image back.
  Picture draw_panels() {
    const Status status = render();
    EXPECT_TRUE(status.ok()) << status.message();
    std::ofstream(png_, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes_.data()),
               static_cast<std::streamsize>(bytes_.size()));
    return Picture(png_);
  }

  // Renders, expects invalid_argument and no image, and returns the message.
  std::string refusal() {
    const Status status = render();
    EXPECT_EQ(status.code(), StatusCode::invalid_argument);
    EXPECT_TRUE(bytes_.empty());
    return status.message();
  }

  [[nodiscard]] PanelGrid grid() const {
    return arrange_panels(side_by_side_.width, panels_.size());
  }

  const std::vector<Label> found_ = {Label::ground};
  const std::vector<Label> missed_ = {Label::nonground};
  LabelledScan scan_;
  std::vector<Truth> truth_ = {Truth::ground};
  std::vector<Panel> panels_;
  SideBySide side_by_side_;
  std::vector<std::byte> bytes_;
};

TEST_F(SideBySideImage, ShowsTheErrorsOfEachMethod) {
  add_panel(found_);
  add_panel(missed_);

  const Picture picture = draw_panels();

  EXPECT_GT(picture.count(grid().panels[0], green), 0);
  EXPECT_EQ(picture.count(grid().panels[0], blue), 0);
  EXPECT_GT(picture.count(grid().panels[1], blue), 0);
  EXPECT_EQ(picture.count(grid().panels[1], green), 0);
}

TEST_F(SideBySideImage, ShowsFalsePositivesInRed) {
  truth_ = {Truth::not_ground};
  add_panel(found_);

  EXPECT_GT(draw_panels().count(grid().panels[0], red), 0);
}

TEST_F(SideBySideImage, DrawsAPointAtTheSamePositionInEveryPanel) {
  for (int panel = 0; panel < 5; ++panel) add_panel(found_);

  const Picture picture = draw_panels();

  for (const Rectangle& panel : grid().panels) {
    const Picture::Place place = picture.place(panel, green);
    const double pixels_per_metre = panel.width / 80;
    EXPECT_NEAR(place.column, panel.center_x() - 10 * pixels_per_metre, 1);
    EXPECT_NEAR(place.row, panel.center_y() - 20 * pixels_per_metre, 1);
  }
}

TEST_F(SideBySideImage, HasTheRequestedWidthAndRoomForAllRows) {
  for (int panel = 0; panel < 9; ++panel) add_panel(found_);

  const Picture picture = draw_panels();

  EXPECT_EQ(picture.width(), 900);
  EXPECT_EQ(picture.height(), grid().height);
  EXPECT_LT(grid().panels.back().bottom(), grid().legend.y);
  EXPECT_LE(grid().legend.bottom(), picture.height());
}

TEST_F(SideBySideImage, IsDeterministic) {
  add_panel(found_);
  ASSERT_TRUE(render().ok());
  const std::vector<std::byte> first = bytes_;

  ASSERT_TRUE(render().ok());

  EXPECT_EQ(bytes_, first);
}

TEST_F(SideBySideImage, AcceptsTextThatIsNotUtf8) {
  add_panel(found_);
  panels_[0].title = "\xFF\n";
  side_by_side_.title = "\xC0\x80";

  EXPECT_TRUE(render().ok());
}

TEST_F(SideBySideImage, AcceptsAScanWithoutPoints) {
  scan_ = {};
  truth_.clear();
  side_by_side_.range = 0;
  add_panel({});

  EXPECT_TRUE(render().ok());
}

TEST_F(SideBySideImage, RejectsNoPanelsAndTooManyPanels) {
  EXPECT_THAT(refusal(), HasSubstr("0 panels (expected 1 to 30)"));
  for (int panel = 0; panel < 31; ++panel) add_panel(found_);
  EXPECT_THAT(refusal(), HasSubstr("31 panels"));
}

TEST_F(SideBySideImage, ReportsTheMethodWithLabelsOfAnotherCloud) {
  const std::array<Label, 2> too_many = {};
  add_panel(too_many);

  EXPECT_THAT(refusal(), HasSubstr("RANSAC: 2 labels for 1 points"));
}

TEST_F(SideBySideImage, RejectsGroundTruthOfAnotherLength) {
  add_panel(found_);
  truth_.clear();

  EXPECT_THAT(refusal(), HasSubstr("0 entries for 1 points"));
}

TEST_F(SideBySideImage, RejectsAWidthOutOfLimits) {
  add_panel(found_);
  for (const int width : {639, 8193}) {
    side_by_side_.width = width;
    EXPECT_THAT(refusal(), HasSubstr("640 to 8192"));
  }
}

TEST_F(SideBySideImage, RejectsARangeOutOfLimits) {
  add_panel(found_);
  for (const float range : {-1.0f, 0.5f, 1001.0f, std::numeric_limits<float>::quiet_NaN()}) {
    side_by_side_.range = range;
    EXPECT_THAT(refusal(), HasSubstr("1 to 1000"));
  }
}

TEST(PanelGrid, StaysWithinTheMaximumImageHeight) {
  for (std::size_t count = 1; count <= 30; ++count)
    EXPECT_LE(arrange_panels(8192, count).height, 32767) << count << " panels";
}

TEST(PanelGrid, HasAtMostThreePanelsInARow) {
  for (const std::size_t count : {1u, 2u, 3u, 4u, 5u, 9u, 30u}) {
    const PanelGrid grid = arrange_panels(1800, count);

    ASSERT_EQ(grid.panels.size(), count);
    for (const Rectangle& panel : grid.panels) {
      EXPECT_GE(panel.width, 1720.0 / 3 - 24);
      EXPECT_EQ(panel.width, panel.height);
      EXPECT_LE(panel.right(), 1760);
    }
  }
}

}  // namespace
}  // namespace flagstone::render
