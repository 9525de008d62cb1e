// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>

#include <limits>

#include "files/render/birds_eye.hpp"
#include "files/render/picture.hpp"

namespace flagstone::render {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class BirdsEyeErrors : public PictureTest {
 protected:
  BirdsEyeErrors() { scan_.add(10, 0, 0, Label::ground); }

  // Draws, expects invalid_argument and no file, and returns the message.
  std::string refusal() {
    const Status status = draw_birds_eye(png_, scan_.cloud(), scan_.result, options_);
    EXPECT_EQ(status.code(), StatusCode::invalid_argument);
    EXPECT_TRUE(std::filesystem::is_empty(folder_));
    EXPECT_THAT(status.message(), Not(HasSubstr("\n")));
    return status.message();
  }

  LabelledScan scan_;
};

TEST_F(BirdsEyeErrors, ReportsAMissingDirectoryOnOneLineAndLeavesNothing) {
  const std::filesystem::path png = folder_ / "absent" / "scan.png";

  const Status status = draw_birds_eye(png, scan_.cloud(), scan_.result, options_);

  EXPECT_EQ(status.code(), StatusCode::unwritable);
  EXPECT_THAT(status.message(), AllOf(HasSubstr(png.string()), Not(HasSubstr("\n"))));
  EXPECT_TRUE(std::filesystem::is_empty(folder_));
}

TEST_F(BirdsEyeErrors, RejectsLabelsOfAnotherCloud) {
  scan_.points.push_back(scan_.points.front());

  EXPECT_THAT(refusal(), HasSubstr("1 labels for 2 points"));
}

TEST_F(BirdsEyeErrors, RejectsACloudWithoutMemory) {
  const Status status = draw_birds_eye(png_, CloudView(nullptr, 1), scan_.result, options_);

  EXPECT_EQ(status.code(), StatusCode::invalid_argument);
  EXPECT_THAT(status.message(), HasSubstr("but no memory"));
}

TEST_F(BirdsEyeErrors, RejectsAReferenceOfAnotherLength) {
  const std::vector<Truth> reference(3, Truth::ground);
  options_.reference = reference;

  EXPECT_THAT(refusal(), HasSubstr("3 entries for 1 points"));
}

TEST_F(BirdsEyeErrors, ReportsTheLimitsOfTheSize) {
  options_.width = 319;
  EXPECT_THAT(refusal(), HasSubstr("319 x 890 pixels (expected 320 to 8192 each)"));
  options_.width = 800;
  options_.height = 8193;
  EXPECT_THAT(refusal(), HasSubstr("800 x 8193 pixels"));
}

TEST_F(BirdsEyeErrors, ReportsTheLimitsOfTheRange) {
  for (const float range : {-10.0f, 0.5f, 1001.0f, std::numeric_limits<float>::infinity(),
                            std::numeric_limits<float>::quiet_NaN()}) {
    options_.range = range;
    EXPECT_THAT(refusal(), HasSubstr("1 to 1000"));
  }
}

TEST_F(BirdsEyeErrors, RejectsTintedPatchesWithoutZones) {
  options_.tint_patches = true;

  EXPECT_THAT(refusal(), HasSubstr("requires the zones"));
}

TEST_F(BirdsEyeErrors, ReportsAnInvalidConfiguration) {
  PatchworkConfig config;
  config.zones.clear();
  options_.zones = &config;

  EXPECT_THAT(refusal(), HasSubstr("zones"));
}

TEST_F(BirdsEyeErrors, ReportsAPatchThatIsNotInTheZones) {
  const PatchworkConfig config;
  options_.zones = &config;
  options_.tint_patches = true;
  const auto count = [](auto number) { return static_cast<std::uint16_t>(number); };
  const std::vector<Patch> strangers = {
      {.zone = count(config.zones.size())},
      {.zone = 1, .ring = count(config.zones[1].ring_radii.size())},
      {.zone = 1, .sector = count(config.zones[1].sectors)},
  };
  for (const Patch& stranger : strangers) {
    scan_.result.mutable_patches() = {Patch{}, stranger};

    EXPECT_THAT(refusal(), HasSubstr("patch 1 is zone " + std::to_string(stranger.zone)));
  }
}

}  // namespace
}  // namespace flagstone::render
