// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "files/ros/livox_message.hpp"

#include <gtest/gtest.h>

#include "files/io/status_matchers.hpp"
#include "files/ros/coordinates.hpp"
#include "files/ros/field_convention.hpp"
#include "files/ros/messages.hpp"

namespace flagstone::ros {
namespace {

using io::fails;
using io::is_bad_at;
using io::is_ok;
using ::testing::HasSubstr;
using ::testing::StartsWith;

class LivoxInAnyFormat : public ::testing::TestWithParam<MessageFormat> {};
INSTANTIATE_TEST_SUITE_P(Formats, LivoxInAnyFormat, ::testing::ValuesIn(all_formats));

TEST_P(LivoxInAnyFormat, IsReadAsACloud) {
  const Bytes message = livox_message(GetParam(), 3);
  PointCloud2View cloud;
  LivoxMessage livox;

  ASSERT_THAT(parse_livox(message, GetParam().encoding, cloud, livox), is_ok());

  EXPECT_EQ(cloud.header.frame_id, "livox_frame");
  EXPECT_EQ(livox.timebase, 1700000000000000005U);
  EXPECT_EQ(livox.lidar_id, 192);
  EXPECT_EQ(cloud.size(), 3U);
  EXPECT_EQ(cloud.point_step, 19U);
  EXPECT_EQ(cloud.point_stride(), GetParam().encoding == Encoding::cdr ? 20U : 19U);
  EXPECT_THAT(check(cloud), is_ok());

  std::vector<float> copy;
  CloudView points;
  ASSERT_THAT(view_coordinates(cloud, copy, points), is_ok());
  EXPECT_EQ(copy.empty(), !GetParam().big_endian) << "zero-copy in the native byte order";
  ASSERT_EQ(points.size(), 3U);
  EXPECT_EQ(points[2].x, 3.F);
  EXPECT_EQ(points[2].y, 0.5F);
  EXPECT_EQ(points[2].z, -1.F);
  EXPECT_EQ(std::to_integer<int>(cloud.data[2 * cloud.point_stride() + 16]), 102);

  const FieldConvention convention = recognize(cloud.fields);
  EXPECT_EQ(convention.convention, Convention::livox);
  EXPECT_EQ(convention.time, cloud.find("offset_time"));
}

TEST_P(LivoxInAnyFormat, IsRejectedIfTruncatedAnywhere) {
  const Bytes whole = livox_message(GetParam(), 2);
  for (std::size_t size = 0; size < whole.size(); ++size) {
    const Bytes part(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size));
    PointCloud2View cloud;
    LivoxMessage livox;
    EXPECT_THAT(parse_livox(part, GetParam().encoding, cloud, livox),
                fails(StatusCode::bad_file, StartsWith("byte ")))
        << size;
    EXPECT_EQ(cloud.size(), 0U);
  }
}

TEST_P(LivoxInAnyFormat, CanHaveNoPoints) {
  PointCloud2View cloud;
  LivoxMessage livox;
  const Bytes message = livox_message(GetParam(), 0);
  ASSERT_THAT(parse_livox(message, GetParam().encoding, cloud, livox), is_ok());
  EXPECT_EQ(cloud.size(), 0U);
  EXPECT_EQ(cloud.fields.size(), 7U);
}

TEST(LivoxMessage, IsRejectedIfTheNumbersOfPointsDiffer) {
  Bytes message = livox_message({Encoding::ros1, false}, 2);
  const std::size_t point_num_at = 4 + 4 + 4 + 4 + 11 + 8;
  message[point_num_at] = std::byte{9};
  PointCloud2View cloud;
  LivoxMessage livox;
  EXPECT_THAT(parse_livox(message, Encoding::ros1, cloud, livox),
              is_bad_at(point_num_at + 8, "the message has 2 points, but point_num is 9"));
}

TEST(LivoxMessage, IsNotAPointCloud2) {
  PointCloud2View cloud;
  LivoxMessage livox;
  for (const MessageFormat& format : all_formats) {
    EXPECT_FALSE(parse(livox_message(format, 100), format.encoding, cloud).ok());
    EXPECT_FALSE(parse_livox(small_message(format).bytes(), format.encoding, cloud, livox).ok());
  }
}

}  // namespace
}  // namespace flagstone::ros
