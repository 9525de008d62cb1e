// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "cloud_segmenter.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <vector>

#include "cloud_message.hpp"
#include "scene.hpp"

namespace flagstone_ros {
namespace {

using flagstone::Label;
using flagstone::ros::DerivedCloud;
using flagstone::ros::PointCloud2View;
using ::testing::HasSubstr;
using ::testing::Optional;

/// A message with its view and a segmenter.
class Segmented {
 public:
  explicit Segmented(const Scene& scene, const ParameterValues& given = {},
                     const Transform& to_sensor = {}, const std::optional<Vector>& up = {})
      : message(scene.message()), segmenter(SegmenterSettings(given)) {
    EXPECT_TRUE(view_message(message, view).ok());
    const flagstone::Status status = segmenter.segment(view, to_sensor, up);
    EXPECT_TRUE(status.ok()) << status.message();
    labels.assign(segmenter.result().labels().begin(), segmenter.result().labels().end());
  }

  [[nodiscard]] std::vector<std::uint8_t> data_of(Output output) {
    DerivedCloud derived;
    EXPECT_TRUE(segmenter.plan(output, view, derived).ok());
    sensor_msgs::msg::PointCloud2 out;
    write_message(derived, out);
    point_step = out.point_step;
    return out.data;
  }

  sensor_msgs::msg::PointCloud2 message;
  PointCloud2View view;
  CloudSegmenter segmenter;
  std::vector<Label> labels;
  std::size_t point_step = 0;
};

TEST(CloudSegmenter, LabelsGroundAndTheWall) {
  const Scene scene;
  const Segmented segmented(scene);

  EXPECT_GT(segmented.segmenter.result().count(Label::ground), scene.ground_count * 95 / 100);
  EXPECT_EQ(segmented.labels.back(), Label::nonground);
}

TEST(CloudSegmenter, DividesThePointsWithAllTheirBytes) {
  Segmented segmented{Scene()};
  std::vector<std::uint8_t> ground;
  std::vector<std::uint8_t> nonground;
  for (std::size_t i = 0; i < segmented.labels.size(); ++i) {
    const auto point = segmented.message.data.begin() + static_cast<std::ptrdiff_t>(20 * i);
    if (segmented.labels[i] == Label::ground) ground.insert(ground.end(), point, point + 20);
    if (segmented.labels[i] == Label::nonground) {
      nonground.insert(nonground.end(), point, point + 20);
    }
  }

  EXPECT_EQ(segmented.data_of(Output::ground), ground);
  EXPECT_EQ(segmented.data_of(Output::nonground), nonground);
}

TEST(CloudSegmenter, AppendsLabelAndHeightToEveryPoint) {
  Segmented segmented{Scene()};

  const std::vector<std::uint8_t> data = segmented.data_of(Output::labelled);

  ASSERT_EQ(segmented.point_step, 28u);
  ASSERT_EQ(data.size(), 28 * segmented.labels.size());
  for (std::size_t i = 0; i < segmented.labels.size(); i += 97) {
    float height = 0;
    std::memcpy(&height, &data[28 * i + 24], 4);
    EXPECT_EQ(std::memcmp(&data[28 * i], &segmented.message.data[20 * i], 20), 0);
    EXPECT_EQ(data[28 * i + 20], static_cast<std::uint8_t>(segmented.labels[i]));
    EXPECT_EQ(std::memcmp(&height, &segmented.segmenter.result().heights()[i], 4), 0);
  }
}

TEST(CloudSegmenter, LabelsACloudInAnotherFrameAsInTheFrameOfTheSensor) {
  Scene moved;
  moved.move(0, 1, 2, 3);
  const Segmented expected{Scene()};

  const Segmented segmented(moved, {}, {.translation = {-1, -2, -3}});

  EXPECT_EQ(segmented.segmenter.result().count(Label::ground),
            expected.segmenter.result().count(Label::ground));
  EXPECT_EQ(segmented.labels, expected.labels);
}

TEST(CloudSegmenter, LevelsACloudWithTheUpDirection) {
  Scene tilted;
  tilted.move(0.35, 0, 0, 0);
  const Vector up = {0, -std::sin(0.35), std::cos(0.35)};

  const Segmented segmented(tilted, {}, {}, up);

  EXPECT_GT(segmented.segmenter.result().count(Label::ground), tilted.ground_count * 95 / 100);
  EXPECT_NEAR(segmented.segmenter.summary().tilt, 20.05, 0.01);
}

TEST(CloudSegmenter, LabelsMissingReturnsInvalidInAnyFrame) {
  Scene scene;
  scene.add(0, 0, 0);
  scene.add(NAN, 1, 1);

  const Segmented segmented(scene, {}, {.translation = {0, 0, 0.5}});

  EXPECT_EQ(segmented.segmenter.result().count(Label::invalid), 2u);
}

TEST(CloudSegmenter, SummarizesThePoseInUse) {
  const CloudSummary summary = Segmented(Scene(), {{"sensor_height", 1.7}}).segmenter.summary();

  EXPECT_NEAR(summary.sensor_height, 1.7, 1e-6);
  EXPECT_EQ(summary.tilt, 0);
  EXPECT_FALSE(summary.mount.empty());
}

TEST(CloudSegmenter, WarnsOnceIfMostPointsAreOutOfRange) {
  Scene scene;
  scene.move(0, 5000, 0, 0);
  Segmented segmented(scene);

  EXPECT_THAT(segmented.segmenter.warning(), Optional(HasSubstr("set mount.scale to 0.001")));
  EXPECT_EQ(segmented.segmenter.warning(), std::nullopt);
  EXPECT_EQ(segmented.segmenter.summary().out_of_range, 1);
}

TEST(CloudSegmenter, ReportsACloudWithoutCoordinates) {
  auto message = Scene().message();
  message.fields[2].name = "depth";
  PointCloud2View view;
  ASSERT_TRUE(view_message(message, view).ok());
  CloudSegmenter segmenter(SegmenterSettings(ParameterValues{}));

  EXPECT_THAT(segmenter.segment(view, {}, {}).message(), HasSubstr("z"));
}

}  // namespace
}  // namespace flagstone_ros
