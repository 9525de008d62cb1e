// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "cloud_message.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scene.hpp"

namespace flagstone_ros {
namespace {

using flagstone::ros::PointCloud2View;
using ::testing::HasSubstr;

TEST(CloudMessage, IsViewedWithoutCopyingItsData) {
  const auto message = Scene().message();
  PointCloud2View view;

  ASSERT_TRUE(view_message(message, view).ok());

  EXPECT_EQ(static_cast<const void*>(view.data.data()), message.data.data());
  EXPECT_EQ(view.size(), Scene().count());
  EXPECT_EQ(view.header.frame_id, "lidar");
  EXPECT_EQ(view.header.sec, 1700000000);
  EXPECT_EQ(view.header.nanosec, 123456789u);
  ASSERT_NE(view.find("ring"), nullptr);
  EXPECT_EQ(view.find("ring")->offset, 16u);
}

TEST(CloudMessage, WithoutFieldsHasNoCoordinates) {
  auto message = Scene().message();
  message.fields.clear();
  PointCloud2View view;

  EXPECT_TRUE(view_message(message, view).ok());
  EXPECT_EQ(view.find("x"), nullptr);
}

TEST(CloudMessage, WithTooFewBytesIsRejected) {
  auto message = Scene().message();
  message.data.resize(message.data.size() - 1);
  PointCloud2View view;

  const flagstone::Status status = view_message(message, view);

  EXPECT_EQ(status.code(), flagstone::StatusCode::invalid_argument);
  EXPECT_THAT(status.message(), HasSubstr("bytes"));
  EXPECT_TRUE(view.fields.empty());
  EXPECT_EQ(view.size(), 0u);
}

TEST(CloudMessage, WithTooManyFieldsIsRejected) {
  auto message = Scene().message();
  message.fields.resize(flagstone::ros::max_point_fields + 1);
  PointCloud2View view;

  EXPECT_THAT(view_message(message, view).message(), HasSubstr("1025 fields are too many"));
}

TEST(CloudMessage, WithSelectedPointsKeepsAllOtherMembers) {
  const auto message = Scene().message();
  PointCloud2View view;
  ASSERT_TRUE(view_message(message, view).ok());
  std::vector<std::uint8_t> mask(view.size(), 0);
  mask[1] = mask[5] = 1;
  flagstone::ros::DerivedCloud derived;
  ASSERT_TRUE(derived.select(view, flagstone::ros::Selection(mask)).ok());
  sensor_msgs::msg::PointCloud2 out;

  write_message(derived, out);

  EXPECT_EQ(out.header.frame_id, message.header.frame_id);
  EXPECT_EQ(out.header.stamp.sec, message.header.stamp.sec);
  EXPECT_EQ(out.header.stamp.nanosec, message.header.stamp.nanosec);
  EXPECT_EQ(out.width, 2u);
  EXPECT_EQ(out.height, 1u);
  EXPECT_EQ(out.point_step, message.point_step);
  EXPECT_EQ(out.row_step, 2 * message.point_step);
  EXPECT_TRUE(out.is_dense);
  ASSERT_EQ(out.fields.size(), message.fields.size());
  EXPECT_EQ(out.fields[4].name, "ring");
  EXPECT_EQ(out.fields[4].datatype, message.fields[4].datatype);
  EXPECT_EQ(out.fields[4].count, 1u);
  ASSERT_EQ(out.data.size(), 40u);
  EXPECT_TRUE(std::equal(out.data.begin(), out.data.begin() + 20, message.data.begin() + 20));
  EXPECT_TRUE(std::equal(out.data.begin() + 20, out.data.end(), message.data.begin() + 100));
}

}  // namespace
}  // namespace flagstone_ros
