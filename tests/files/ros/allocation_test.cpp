// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
// After the first messages nothing is allocated, and a message never causes an allocation beyond
// its size.

#include <gtest/gtest.h>

#include <cstring>
#include <vector>

#include "counted_allocation.hpp"
#include "files/io/status_matchers.hpp"
#include "files/ros/coordinates.hpp"
#include "files/ros/derived_cloud.hpp"
#include "files/ros/livox_message.hpp"
#include "files/ros/messages.hpp"

namespace flagstone::ros {
namespace {

using io::allocated;

// Bytes that formatting an error may allocate.
constexpr std::size_t any_message = std::size_t{4} * 1024;

CloudMessage large_message(PointFieldType type) {
  CloudMessage message = small_message();
  message.width = 1000;
  message.point_step = 32;
  message.row_step = 32000;
  message.data.resize(32000);
  message.fields[0].type = type;
  return message;
}

/// All steps for one message, as a node does them.
struct Codec {
  void run(const Bytes& message, const std::vector<Label>& labels,
           const std::vector<float>& heights) {
    ASSERT_TRUE(parse(message, Encoding::cdr, cloud).ok());
    ASSERT_TRUE(view_coordinates(cloud, copy, points).ok());
    const std::array added{label_field(labels), height_field(heights)};
    ASSERT_TRUE(derived.append(cloud, added).ok());
    ASSERT_TRUE(derived.write_message(out).ok());
    ASSERT_TRUE(derived.select(cloud, Selection(labels, {Label::ground})).ok());
    ASSERT_TRUE(derived.write_message(out).ok());
  }

  PointCloud2View cloud;
  std::vector<float> copy;
  CloudView points;
  DerivedCloud derived;
  Bytes out;
};

TEST(PointCloud2Allocation, IsZeroAfterTheFirstMessage) {
  const std::vector<Label> labels(1000, Label::ground);
  const std::vector<float> heights(1000);
  for (const PointFieldType type : {PointFieldType::float32, PointFieldType::int16}) {
    const Bytes message = large_message(type).bytes();
    Codec codec;
    codec.run(message, labels, heights);
    allocated = 0;

    codec.run(message, labels, heights);

    EXPECT_EQ(allocated, 0U);
  }
}

TEST(PointCloud2Allocation, IsSmallForMessagesWithWrongLengths) {
  CloudMessage message = small_message();
  message.height = 0xffffffffU;
  message.width = 0xffffffffU;
  const Bytes endless_points = message.bytes();
  Bytes endless_fields = small_message().bytes();
  std::memset(endless_fields.data() + 32, 0xff, 4);
  Bytes endless_livox = livox_message({Encoding::ros1, false}, 2);
  const std::size_t point_num_at = 35;
  std::memset(endless_livox.data() + point_num_at, 0xff, 4);
  std::memset(endless_livox.data() + point_num_at + 8, 0xff, 4);
  for (const Bytes& bytes : {endless_points, endless_fields, endless_livox}) {
    for (const Encoding encoding : {Encoding::cdr, Encoding::ros1}) {
      PointCloud2View cloud;
      LivoxMessage livox;
      allocated = 0;
      EXPECT_FALSE(parse(bytes, encoding, cloud).ok());
      EXPECT_FALSE(parse_livox(bytes, encoding, cloud, livox).ok());
      EXPECT_LT(allocated, any_message);
    }
  }
}

TEST(PointCloud2Allocation, FailureIsReported) {
  const Bytes message = small_message().bytes();
  PointCloud2View cloud;
  allocated = 0;
  io::allowed = 16;
  const Status status = parse(message, Encoding::cdr, cloud);
  io::allowed = io::unlimited;
  EXPECT_EQ(status.code(), StatusCode::out_of_memory);
}

}  // namespace
}  // namespace flagstone::ros
