// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "files/ros/coordinates.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "files/io/status_matchers.hpp"
#include "files/ros/messages.hpp"

namespace flagstone::ros {
namespace {

using enum PointFieldType;
using io::fails;
using io::is_ok;
using io::joined;
using io::numbers;
using ::testing::HasSubstr;

/// A parsed message, its points and the memory that they are in.
struct Viewed {
  explicit Viewed(const CloudMessage& message) : bytes(message.bytes()) {
    status = parse(bytes, message.format.encoding, cloud);
    if (status.ok()) status = view_coordinates(cloud, copy, points);
  }

  Bytes bytes;
  PointCloud2View cloud;
  std::vector<float> copy;
  CloudView points;
  Status status;
};

void expect_point(const Point& point, float x, float y, float z) {
  EXPECT_EQ(point.x, x);
  EXPECT_EQ(point.y, y);
  EXPECT_EQ(point.z, z);
}

/// One point whose x, y and z have this type.
template <class T>
CloudMessage message_of(PointFieldType type, std::initializer_list<T> xyz) {
  CloudMessage message;
  const auto size = static_cast<std::uint32_t>(sizeof(T));
  message.width = 1;
  message.fields = {{"x", 0, type, 1}, {"y", size, type, 1}, {"z", 2 * size, type, 1}};
  message.point_step = 3 * size;
  message.row_step = 3 * size;
  message.data = numbers(xyz);
  return message;
}

TEST(Coordinates, AreZeroCopyForFloatsInAnyOrder) {
  CloudMessage message = small_message();
  std::swap(message.fields[0].name, message.fields[2].name);
  const Viewed viewed(message);

  ASSERT_THAT(viewed.status, is_ok());

  EXPECT_TRUE(has_native_coordinates(viewed.cloud));
  EXPECT_EQ(viewed.points.data(), viewed.cloud.data.data());
  EXPECT_TRUE(viewed.copy.empty());
  ASSERT_EQ(viewed.points.size(), 2U);
  expect_point(viewed.points[0], 3, 2, 1);
  expect_point(viewed.points[1], -3, -2, -1);
}

TEST(Coordinates, AreZeroCopyInABigEndianMessageOfLittleEndianPoints) {
  const Viewed viewed(small_message({Encoding::cdr, true}));
  ASSERT_THAT(viewed.status, is_ok());
  EXPECT_TRUE(viewed.copy.empty());
  expect_point(viewed.points[1], -1, -2, -3);
}

TEST(Coordinates, AreConvertedFromPaddedRows) {
  CloudMessage message = small_message();
  message.height = 2;
  message.width = 1;
  message.row_step = 21;
  message.data.insert(message.data.begin() + 18, 3, std::byte{0xff});
  const Viewed viewed(message);

  ASSERT_THAT(viewed.status, is_ok());

  EXPECT_FALSE(has_native_coordinates(viewed.cloud));
  ASSERT_EQ(viewed.points.size(), 2U);
  expect_point(viewed.points[0], 1, 2, 3);
  expect_point(viewed.points[1], -1, -2, -3);
}

TEST(Coordinates, AreConvertedFromEveryNumberType) {
  const auto point_of = [](const CloudMessage& message) {
    const Viewed viewed(message);
    EXPECT_THAT(viewed.status, is_ok());
    return viewed.points.size() == 1 ? viewed.points[0] : Point{0, 0, 0};
  };
  expect_point(point_of(message_of<std::int8_t>(int8, {-1, 2, 3})), -1, 2, 3);
  expect_point(point_of(message_of<std::uint8_t>(uint8, {255, 2, 3})), 255, 2, 3);
  expect_point(point_of(message_of<std::int16_t>(int16, {-300, 2, 3})), -300, 2, 3);
  expect_point(point_of(message_of<std::uint16_t>(uint16, {65535, 2, 3})), 65535, 2, 3);
  expect_point(point_of(message_of<std::int32_t>(int32, {-70000, 2, 3})), -70000, 2, 3);
  expect_point(point_of(message_of<std::uint32_t>(uint32, {70000, 2, 3})), 70000, 2, 3);
  expect_point(point_of(message_of<double>(float64, {-0.5, 2, 3})), -0.5, 2, 3);
  expect_point(point_of(message_of<std::int64_t>(int64, {-70000, 2, 3})), -70000, 2, 3);
  expect_point(point_of(message_of<std::uint64_t>(uint64, {70000, 2, 3})), 70000, 2, 3);
}

TEST(Coordinates, KeepValuesThatAreNotFinite) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  const Viewed viewed(message_of<double>(float64, {nan, infinity, -infinity}));
  ASSERT_THAT(viewed.status, is_ok());
  EXPECT_TRUE(std::isnan(viewed.points[0].x));
  EXPECT_EQ(viewed.points[0].y, std::numeric_limits<float>::infinity());
  EXPECT_EQ(viewed.points[0].z, -std::numeric_limits<float>::infinity());
}

TEST(Coordinates, AreConvertedFromBigEndianPoints) {
  CloudMessage message = message_of<double>(float64, {1.5, -2, 3});
  for (std::size_t i = 0; i < 24; i += 8) {
    std::reverse(message.data.begin() + static_cast<std::ptrdiff_t>(i),
                 message.data.begin() + static_cast<std::ptrdiff_t>(i + 8));
  }
  message.is_bigendian = true;
  const Viewed viewed(message);
  ASSERT_THAT(viewed.status, is_ok());
  expect_point(viewed.points[0], 1.5, -2, 3);
}

TEST(Coordinates, CanHaveDifferentTypes) {
  CloudMessage message = small_message();
  message.fields[0] = {"x", 16, uint16, 1};
  const Viewed viewed(message);
  ASSERT_THAT(viewed.status, is_ok());
  expect_point(viewed.points[1], 6, -2, -3);
}

TEST(Coordinates, CanHaveNoPoints) {
  CloudMessage message = small_message();
  message.width = 0;
  message.data.clear();
  const Viewed viewed(message);
  ASSERT_THAT(viewed.status, is_ok());
  EXPECT_TRUE(viewed.points.empty());
}

TEST(CoordinatesError, NamesTheMissingFieldAndThoseThatExist) {
  CloudMessage message = small_message();
  message.fields[2].name = "range";
  EXPECT_THAT(Viewed(message).status,
              fails(StatusCode::bad_file,
                    HasSubstr("no field 'z' (expected x, y and z; the fields are: 'x' 'y' "
                              "'range' 'intensity' 'ring')")));
  message.fields.clear();
  EXPECT_THAT(Viewed(message).status,
              fails(StatusCode::bad_file, HasSubstr("no field 'x' (expected x, y and z; the fields "
                                                    "are: none)")));
}

TEST(CoordinatesError, IsReportedForSeveralNumbers) {
  CloudMessage message = small_message();
  message.fields[0].count = 2;
  EXPECT_THAT(Viewed(message).status,
              fails(StatusCode::bad_file, HasSubstr("field 'x' has count 2 (expected 1)")));
}

TEST(CoordinatesError, IsReportedForBooleansAndUnknownTypes) {
  CloudMessage message = small_message();
  message.fields[1].type = boolean;
  EXPECT_THAT(Viewed(message).status,
              fails(StatusCode::bad_file, HasSubstr("field 'y' has datatype 11")));
  message.fields[1].type = static_cast<PointFieldType>(77);
  EXPECT_THAT(Viewed(message).status,
              fails(StatusCode::bad_file, HasSubstr("field 'y' has datatype 77")));
}

TEST(TransformedCoordinates, AreRotatedAndMoved) {
  const RigidTransform quarter_turn_about_z = {.rotation = {0, -1, 0, 1, 0, 0, 0, 0, 1},
                                               .translation = {10, 20, 30}};
  const Viewed viewed(message_of<double>(float64, {1, 2, 3}));
  std::vector<float> moved;

  ASSERT_THAT(transform_coordinates(viewed.cloud, quarter_turn_about_z, moved), is_ok());

  EXPECT_EQ(moved, (std::vector<float>{8, 21, 33}));
}

TEST(TransformedCoordinates, KeepMissingReturnsAndMakeNoOthers) {
  const RigidTransform shift = {.translation = {-1, -2, -3}};
  std::vector<float> moved;

  const Viewed missing(message_of<float>(float32, {0, 0, 0}));
  ASSERT_THAT(transform_coordinates(missing.cloud, shift, moved), is_ok());
  EXPECT_EQ(moved, (std::vector<float>{0, 0, 0}));

  const Viewed at_new_origin(message_of<float>(float32, {1, 2, 3}));
  ASSERT_THAT(transform_coordinates(at_new_origin.cloud, shift, moved), is_ok());
  EXPECT_NE(moved, (std::vector<float>{0, 0, 0}));
}

TEST(TransformedCoordinates, OfACloudWithoutZAreAnError) {
  CloudMessage message = message_of<float>(float32, {1, 2, 3});
  message.fields.pop_back();
  const Viewed viewed(message);
  std::vector<float> moved;

  EXPECT_THAT(transform_coordinates(viewed.cloud, {}, moved),
              fails(StatusCode::bad_file, HasSubstr("no field 'z'")));
}

}  // namespace
}  // namespace flagstone::ros
