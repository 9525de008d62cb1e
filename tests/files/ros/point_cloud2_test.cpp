// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "files/ros/point_cloud2.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "files/io/status_matchers.hpp"
#include "files/ros/messages.hpp"

namespace flagstone::ros {
namespace {

using io::fails;
using io::is_bad_at;
using io::is_ok;
using io::numbers;
using ::testing::HasSubstr;
using ::testing::StartsWith;

// Offsets in the CDR message of small_message(): encapsulation 0, stamp 4 and 8, frame_id 12 to 22,
// height 24, width 28, number of fields 32.
constexpr std::size_t height_at = 24;
constexpr std::size_t fields_at = 32;

Status error_of(const Bytes& message, Encoding encoding = Encoding::cdr) {
  PointCloud2View cloud;
  cloud.fields.resize(3);
  cloud.width = 5;
  Status status = parse(message, encoding, cloud);
  EXPECT_TRUE(cloud.fields.empty()) << "a failed read leaves fields";
  EXPECT_EQ(cloud.size(), 0U) << "a failed read leaves points";
  return status;
}

Status error_of(const CloudMessage& message) {
  return error_of(message.bytes(), message.format.encoding);
}

class PointCloud2InAnyFormat : public ::testing::TestWithParam<MessageFormat> {};
INSTANTIATE_TEST_SUITE_P(Formats, PointCloud2InAnyFormat, ::testing::ValuesIn(all_formats));

TEST_P(PointCloud2InAnyFormat, IsParsedWithoutCopying) {
  const Bytes message = small_message(GetParam()).bytes();
  PointCloud2View cloud;

  ASSERT_THAT(parse(message, GetParam().encoding, cloud), is_ok());

  EXPECT_EQ(cloud.format, GetParam());
  EXPECT_EQ(cloud.header.seq, GetParam().encoding == Encoding::ros1 ? 7U : 0U);
  EXPECT_EQ(cloud.header.sec, 1700000000);
  EXPECT_EQ(cloud.header.nanosec, 123456789U);
  EXPECT_EQ(cloud.header.frame_id, "lidar");
  EXPECT_EQ(cloud.height, 1U);
  EXPECT_EQ(cloud.width, 2U);
  EXPECT_EQ(cloud.fields, small_message().fields);
  EXPECT_FALSE(cloud.is_bigendian);
  EXPECT_EQ(cloud.point_step, 18U);
  EXPECT_EQ(cloud.row_step, 36U);
  EXPECT_TRUE(cloud.is_dense);
  ASSERT_EQ(cloud.data.size(), 36U);
  EXPECT_GE(cloud.data.data(), message.data());
  EXPECT_LT(cloud.data.data(), message.data() + message.size());
  EXPECT_TRUE(std::ranges::equal(cloud.data, small_message().data));
}

TEST_P(PointCloud2InAnyFormat, SurvivesARoundTripUnchanged) {
  const Bytes message = small_message(GetParam()).bytes();
  PointCloud2View cloud;
  ASSERT_THAT(parse(message, GetParam().encoding, cloud), is_ok());
  Bytes again(3, std::byte{0xff});

  ASSERT_THAT(serialize(cloud, again), is_ok());

  EXPECT_EQ(again, message);
  EXPECT_EQ(serialized_size(cloud, cloud.data.size()), message.size());
}

TEST_P(PointCloud2InAnyFormat, IsRejectedIfTruncatedAnywhere) {
  const Bytes whole = small_message(GetParam()).bytes();
  for (std::size_t size = 0; size < whole.size(); ++size) {
    const Bytes part(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size));
    EXPECT_THAT(error_of(part, GetParam().encoding),
                fails(StatusCode::bad_file, StartsWith("byte ")))
        << size;
  }
}

TEST_P(PointCloud2InAnyFormat, CanHaveNoPointsAndNoFields) {
  CloudMessage message;
  message.format = GetParam();
  const Bytes bytes = message.bytes();
  PointCloud2View cloud;

  ASSERT_THAT(parse(bytes, GetParam().encoding, cloud), is_ok());

  EXPECT_EQ(cloud.size(), 0U);
  EXPECT_TRUE(cloud.fields.empty());
}

TEST(PointCloud2, KeepsNegativeSecondsOfRos2) {
  CloudMessage message = small_message();
  message.sec = static_cast<std::uint32_t>(-5);
  const Bytes bytes = message.bytes();
  PointCloud2View cloud;
  ASSERT_THAT(parse(bytes, Encoding::cdr, cloud), is_ok());
  EXPECT_EQ(cloud.header.sec, -5);
}

TEST(PointCloud2, AcceptsPaddingAtTheEndOfCdr) {
  Bytes message = small_message().bytes();
  PointCloud2View cloud;
  for (int i = 0; i < 3; ++i) {
    message.push_back(std::byte{0});
    EXPECT_THAT(parse(message, Encoding::cdr, cloud), is_ok());
  }
  message.push_back(std::byte{0});
  EXPECT_THAT(error_of(message), is_bad_at(message.size() - 4, "4 bytes follow the last member"));
}

TEST(PointCloud2, RejectsAnyBytesAfterAMessageOfRos1) {
  Bytes message = small_message({Encoding::ros1, false}).bytes();
  message.push_back(std::byte{0});
  EXPECT_THAT(error_of(message, Encoding::ros1),
              is_bad_at(message.size() - 1, "1 bytes follow the last member"));
}

TEST(PointCloud2, AcceptsCountZeroAsOne) {
  CloudMessage message = small_message();
  message.fields[4].count = 0;
  const Bytes bytes = message.bytes();
  PointCloud2View cloud;
  ASSERT_THAT(parse(bytes, Encoding::cdr, cloud), is_ok());
  EXPECT_EQ(cloud.fields[4].numbers(), 1U);
  EXPECT_EQ(cloud.fields[4].count, 0U);
}

TEST(PointCloud2, AcceptsFieldsOfUnknownTypes) {
  CloudMessage message = small_message();
  message.fields[3].type = static_cast<PointFieldType>(200);
  message.fields[3].offset = 4000000000U;
  const Bytes bytes = message.bytes();
  PointCloud2View cloud;
  ASSERT_THAT(parse(bytes, Encoding::cdr, cloud), is_ok());
  EXPECT_EQ(cloud.fields[3].size(), 0U);
}

TEST(PointCloud2, HasFieldsOfEveryType) {
  const std::vector<std::size_t> sizes{1, 1, 2, 2, 4, 4, 4, 8, 8, 8, 1};
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    EXPECT_EQ(size_of(static_cast<PointFieldType>(i + 1)), sizes[i]);
  }
  EXPECT_EQ(size_of(static_cast<PointFieldType>(0)), 0U);
  EXPECT_EQ(size_of(static_cast<PointFieldType>(12)), 0U);
}

TEST(PointCloud2, CanBeOrganizedWithPaddedRows) {
  CloudMessage message = small_message();
  message.height = 2;
  message.width = 1;
  message.row_step = 32;
  message.data.resize(32 + 18);  // no padding after the last row
  const Bytes bytes = message.bytes();
  PointCloud2View cloud;
  ASSERT_THAT(parse(bytes, Encoding::cdr, cloud), is_ok());
  EXPECT_EQ(cloud.row_stride(), 32U);
  EXPECT_FALSE(cloud.rows_are_contiguous());
}

TEST(PointCloud2, IgnoresARowStepThatIsTooSmallIfTheRowsAreContiguous) {
  CloudMessage message = small_message();
  message.height = 2;
  message.width = 1;
  message.row_step = 0;
  const Bytes bytes = message.bytes();
  PointCloud2View cloud;
  ASSERT_THAT(parse(bytes, Encoding::cdr, cloud), is_ok());
  EXPECT_TRUE(cloud.rows_are_contiguous());
  EXPECT_EQ(cloud.row_stride(), 18U);
}

TEST(PointCloud2, MayHaveBytesAfterTheLastPoint) {
  CloudMessage message = small_message();
  message.data.resize(100);
  const Bytes bytes = message.bytes();
  PointCloud2View cloud;
  ASSERT_THAT(parse(bytes, Encoding::cdr, cloud), is_ok());
  EXPECT_EQ(cloud.size(), 2U);
}

TEST(PointCloud2Error, NamesTheEncapsulation) {
  Bytes message = small_message().bytes();
  message[1] = std::byte{3};
  EXPECT_THAT(error_of(message), is_bad_at(0, "CDR encapsulation 0x0003 is not supported"));
  message[0] = std::byte{0x70};
  EXPECT_THAT(error_of(message), is_bad_at(0, "0x7003"));
}

TEST(PointCloud2Error, NamesTheMemberAndTheBytes) {
  const Bytes whole = small_message().bytes();
  EXPECT_THAT(error_of(Bytes(whole.begin(), whole.begin() + 3)),
              is_bad_at(0, "within encapsulation header (3 bytes remain, expected 4;"));
  EXPECT_THAT(error_of(Bytes(whole.begin(), whole.begin() + 30)),
              is_bad_at(28, "within width (2 bytes remain, expected 4;"));
}

TEST(PointCloud2Error, IsReportedForAnotherEncoding) {
  EXPECT_EQ(error_of(small_message().bytes(), Encoding::ros1).code(), StatusCode::bad_file);
  EXPECT_EQ(error_of(small_message({Encoding::ros1, false}).bytes(), Encoding::cdr).code(),
            StatusCode::bad_file);
  const Bytes little = small_message().bytes();
  Bytes wrong = little;
  wrong[1] = std::byte{0};
  EXPECT_EQ(error_of(wrong).code(), StatusCode::bad_file);
}

TEST(PointCloud2Error, IsReportedForLengthsBeyondTheMessage) {
  CloudMessage message = small_message();
  Bytes bytes = message.bytes();
  const Bytes endless = numbers<std::uint32_t>({0xffffffffU});
  std::ranges::copy(endless, bytes.begin() + 12);
  EXPECT_THAT(error_of(bytes), is_bad_at(16, "within header.frame_id"));
  bytes = message.bytes();
  std::ranges::copy(endless, bytes.begin() + fields_at);
  EXPECT_THAT(error_of(bytes), is_bad_at(fields_at, "4294967295 fields do not fit"));
}

TEST(PointCloud2Error, IsReportedForTooManyFields) {
  CloudMessage message = small_message();
  message.fields.resize(max_point_fields + 1, message.fields[4]);
  EXPECT_THAT(error_of(message), is_bad_at(fields_at, "has 1025 fields (expected at most 1024)"));
}

TEST(PointCloud2Error, IsReportedForAStringWithoutNull) {
  Bytes bytes = small_message().bytes();
  bytes[21] = std::byte{'x'};
  EXPECT_THAT(error_of(bytes), is_bad_at(21, "header.frame_id has no null character at its end"));
}

TEST(PointCloud2Error, IsReportedForABooleanThatIsNeither) {
  Bytes bytes = small_message().bytes();
  bytes.back() = std::byte{2};
  EXPECT_THAT(error_of(bytes), is_bad_at(bytes.size() - 1, "is_dense is 2 (expected 0 or 1"));
}

TEST(PointCloud2Error, IsReportedForAFieldBeyondThePoint) {
  CloudMessage message = small_message();
  message.fields[4].offset = 17;
  EXPECT_THAT(error_of(message),
              is_bad_at(fields_at,
                        "field 'ring' ends at byte 19 of a point (expected at most "
                        "point_step, 18)"));
  message = small_message();
  message.fields[0].count = 0xffffffffU;
  EXPECT_THAT(error_of(message), is_bad_at(fields_at, "field 'x' ends at byte 17179869180"));
}

TEST(PointCloud2Error, IsReportedForDataThatIsTooShort) {
  CloudMessage message = small_message();
  message.data.pop_back();
  EXPECT_THAT(error_of(message), is_bad_at(height_at,
                                           "the data has 35 bytes, too few for height 1 "
                                           "times width 2 points (expected point_step 18,"
                                           " row_step 36;"));
  message = small_message();
  message.height = 2;
  message.width = 1;
  message.row_step = 18;
  message.data.pop_back();
  EXPECT_THAT(error_of(message),
              is_bad_at(height_at, "the data has 35 bytes, too few for height 2"));
  message = small_message();
  message.height = 0xffffffffU;
  message.width = 0xffffffffU;
  EXPECT_THAT(error_of(message), is_bad_at(height_at, "too few for height 4294967295"));
  message.width = 1;
  EXPECT_THAT(error_of(message), is_bad_at(height_at, "too few for height 4294967295"));
  message.row_step = 0;
  EXPECT_THAT(error_of(message), is_bad_at(height_at, "too few for height 4294967295"));
  message.height = 2;
  message.row_step = 0xffffffffU;
  EXPECT_THAT(error_of(message), is_bad_at(height_at, "too few"));
}

TEST(PointCloud2Error, IsReportedForPointsOfNoBytes) {
  CloudMessage message = small_message();
  message.fields.clear();
  message.point_step = 0;
  EXPECT_THAT(error_of(message), is_bad_at(height_at, "point_step is 0 (expected at least 1"));
}

TEST(PointCloud2Error, IsReportedForRowsThatAreNotKnown) {
  CloudMessage message = small_message();
  message.height = 2;
  message.width = 1;
  message.row_step = 10;
  message.data.resize(37);
  EXPECT_THAT(error_of(message), is_bad_at(height_at, "row_step is 10 (expected at least 18"));
}

TEST(PointCloud2Check, ReportsTheSameForAViewThatWasNotParsed) {
  CloudMessage message = small_message();
  PointCloud2View cloud;
  cloud.height = 1;
  cloud.width = 3;
  cloud.point_step = 18;
  cloud.row_step = 54;
  cloud.data = message.data;
  EXPECT_THAT(check(cloud), fails(StatusCode::invalid_argument, HasSubstr("too few")));
  cloud.width = 2;
  EXPECT_THAT(check(cloud), is_ok());
}

TEST(PointCloud2Serialize, ChecksTheView) {
  PointCloud2View cloud;
  cloud.height = 1;
  cloud.width = 3;
  Bytes out;
  EXPECT_THAT(serialize(cloud, out), fails(StatusCode::invalid_argument, HasSubstr("point_step")));
  cloud = PointCloud2View();
  cloud.fields.resize(max_point_fields + 1);
  EXPECT_THAT(serialize(cloud, out), fails(StatusCode::invalid_argument, HasSubstr("1025 fields")));
  cloud = PointCloud2View();
  cloud.padded_point_step = 20;
  EXPECT_THAT(serialize(cloud, out), fails(StatusCode::invalid_argument, HasSubstr("padded")));
}

}  // namespace
}  // namespace flagstone::ros
