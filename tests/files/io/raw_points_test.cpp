// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <utility>

#include "files/io/bytes.hpp"
#include "files/io/read_cloud.hpp"
#include "files/io/status_matchers.hpp"

namespace flagstone::io {
namespace {

using ::testing::HasSubstr;

TEST(RawPoints, AreReadRowByRow) {
  Cloud cloud;
  const Bytes file = numbers({1.0F, 2.0F, 3.0F, 0.5F, 4.0F, 5.0F, 6.0F, 0.25F});

  ASSERT_THAT(read_raw_points(file, 4, cloud), is_ok());

  EXPECT_EQ(cloud.size(), 2U);
  EXPECT_EQ(cloud.view()[1].z, 6.0F);
  EXPECT_EQ(cloud.value(1, *cloud.find("intensity")), 0.25);
}

TEST(RawPoints, AreAdoptedWithoutCopying) {
  Cloud cloud;
  Bytes file = numbers({1.0F, 2.0F, 3.0F, 0.5F});
  const std::byte* const place = file.data();

  ASSERT_THAT(adopt_raw_points(std::move(file), 4, cloud), is_ok());

  EXPECT_EQ(cloud.bytes().data(), place);
  EXPECT_EQ(cloud.view()[0].z, 3.0F);
}

TEST(RawPoints, RejectAnIncompletePoint) {
  Cloud cloud;
  EXPECT_THAT(adopt_raw_points(Bytes(45), 4, cloud), is_bad_at(32, "45 bytes"));
  EXPECT_THAT(adopt_raw_points(Bytes(45), 2, cloud),
              fails(StatusCode::invalid_argument, HasSubstr("expected 3 to 1024")));
}

TEST(RawPoints, MayBeEmpty) {
  Cloud cloud;
  EXPECT_THAT(read_raw_points({}, 5, cloud), is_ok());
  EXPECT_TRUE(cloud.empty());
  EXPECT_EQ(cloud.fields().size(), 5U);
}

TEST(RawPoints, ReportSizeRowAndColumnsOfAnIncompletePoint) {
  Cloud cloud;
  const Status status = read_raw_points(Bytes(45), 4, cloud);

  EXPECT_THAT(status, is_bad_at(32, "45 bytes"));
  EXPECT_THAT(status, is_bad_at(32, "4 floats, 16 bytes each"));
  EXPECT_THAT(status, is_bad_at(32, "check the number of columns"));
}

TEST(RawPoints, Require3To1024Columns) {
  for (const std::size_t columns : {std::size_t{0}, std::size_t{2}, max_fields + 1, SIZE_MAX}) {
    Cloud cloud;
    EXPECT_THAT(read_raw_points(Bytes(16), columns, cloud),
                fails(StatusCode::invalid_argument, HasSubstr("expected 3 to 1024")));
  }
}

TEST(RawPoints, AreWrittenUnchanged) {
  Cloud cloud;
  const Bytes file = numbers({1.0F, 2.0F, 3.0F, 0.5F});
  ASSERT_THAT(read_raw_points(file, 4, cloud), is_ok());
  Bytes again;

  ASSERT_THAT(write_raw_points(cloud, again), is_ok());

  EXPECT_EQ(again, file);
}

TEST(RawPoints, RejectOtherTypes) {
  Cloud cloud;
  ASSERT_THAT(Cloud::from_rows({{"x"}, {"y"}, {"z"}, {"label", FieldType::uint8}}, {}, cloud),
              is_ok());
  Bytes file;
  EXPECT_THAT(write_raw_points(cloud, file),
              fails(StatusCode::invalid_argument, HasSubstr("'label' is uint8")));
}

TEST(RawPoints, RejectAnotherFieldOrder) {
  Cloud cloud;
  ASSERT_THAT(Cloud::from_rows({{"y"}, {"x"}, {"z"}}, {}, cloud), is_ok());
  Bytes file;
  EXPECT_THAT(write_raw_points(cloud, file),
              fails(StatusCode::invalid_argument, HasSubstr("expected x, y and z first")));
}

}  // namespace
}  // namespace flagstone::io
