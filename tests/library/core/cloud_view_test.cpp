// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "flagstone/cloud_view.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

namespace flagstone {
namespace {

void expect_point(Point p, float x, float y, float z) {
  EXPECT_EQ(p.x, x);
  EXPECT_EQ(p.y, y);
  EXPECT_EQ(p.z, z);
}

TEST(CloudView, IsEmptyByDefault) {
  const CloudView cloud;

  EXPECT_TRUE(cloud.empty());
  EXPECT_EQ(cloud.size(), 0u);
}

TEST(CloudView, ReadsPackedFloatsOfAnyWidth) {
  constexpr std::array<float, 12> floats = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12};

  expect_point(CloudView(floats.data(), 4)[1], 4, 5, 6);
  expect_point(CloudView(floats.data(), 3, 4)[1], 5, 6, 7);
  expect_point(CloudView(floats.data(), 2, 5)[1], 6, 7, 8);
}

TEST(CloudView, ReadsAUserStructWithCoordinatesAtAnyOffset) {
  struct Echo {
    std::uint16_t ring;
    float z;
    double time;
    float y;
    float x;
  };
  const std::vector<Echo> echoes = {{1, 3, 0.5, 2, 1}, {2, 6, 0.6, 5, 4}};

  const CloudView cloud{std::span(echoes)};

  ASSERT_EQ(cloud.size(), 2u);
  expect_point(cloud[0], 1, 2, 3);
  expect_point(cloud[1], 4, 5, 6);
}

TEST(CloudView, ReadsUnalignedRecords) {
  std::vector<std::byte> blob(2 * 15);
  for (std::size_t i = 0; i < 2; ++i) {
    const std::array<float, 3> xyz = {1.5f, -2.5f, static_cast<float>(i)};
    std::memcpy(blob.data() + 15 * i + 3, xyz.data(), sizeof xyz);
  }

  const CloudView cloud(blob.data(), 2, {.stride = 15, .x = 3, .y = 7, .z = 11});

  expect_point(cloud[1], 1.5f, -2.5f, 1);
}

TEST(CloudView, ReadsPlanarStorage) {
  constexpr std::array<float, 9> planes = {1, 2, 3, 10, 20, 30, 100, 200, 300};

  const CloudView cloud(planes.data(), 3, {.stride = 4, .x = 0, .y = 12, .z = 24});

  expect_point(cloud[2], 3, 30, 300);
}

TEST(CloudView, ReadsBackwardsWithANegativeStride) {
  constexpr std::array<float, 6> floats = {1, 2, 3, 4, 5, 6};

  const CloudView cloud(floats.data() + 3, 2, {.stride = -12, .x = 0, .y = 4, .z = 8});

  expect_point(cloud[0], 4, 5, 6);
  expect_point(cloud[1], 1, 2, 3);
}

}  // namespace
}  // namespace flagstone
