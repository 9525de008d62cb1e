// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
//
// Counts the memory that operator new allocates, in a separate program.
#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "counted_allocation.hpp"
#include "library/c_api/owned_handles.hpp"
#include "random_cloud.hpp"

namespace flagstone {
namespace {

using tests::cloud_of;
using tests::empty_segmentation;
using tests::OwnedSegmentation;
using tests::OwnedSegmenter;
using tests::random_cloud;
using tests::segmenter_of;

/// What `call` returns if no memory is available.
template <class Call>
flagstone_status without_memory(const Call& call) {
  io::allocated = 0;
  io::allowed = 0;
  const flagstone_status status = call();
  io::allowed = io::unlimited;
  return status;
}

class CAllocation : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(AllMethods, CAllocation, testing::Values("surface", "patchwork"),
                         [](const auto& method) { return std::string(method.param); });

TEST_P(CAllocation, OnlyTheFirstScanAllocates) {
  const OwnedSegmenter segmenter = segmenter_of(GetParam());
  const OwnedSegmentation result = empty_segmentation();
  const std::vector<Point> points = random_cloud(60000, 1);
  const std::vector<Point> others = random_cloud(50000, 2);
  const std::array<float, 4> xy = {10, 0, 3, 4};
  std::array<float, 2> heights{};
  flagstone_error error;
  ASSERT_EQ(flagstone_segment(segmenter.get(), cloud_of(points), result.get(), &error),
            FLAGSTONE_OK);

  io::allocated = 0;
  for (const auto* cloud : {&others, &points, &others}) {
    ASSERT_EQ(flagstone_segment(segmenter.get(), cloud_of(*cloud), result.get(), &error),
              FLAGSTONE_OK);
    flagstone_segmentation_ground_heights(result.get(), xy.data(), 2, heights.data(), &error);
  }

  EXPECT_EQ(io::allocated, 0U);
}

TEST_P(CAllocation, HandlesFreeTheirMemory) {
  const std::ptrdiff_t before = io::blocks;
  {
    const OwnedSegmenter segmenter = segmenter_with(tests::settings_of(GetParam()), 2);
    const OwnedSegmentation result = empty_segmentation();
    flagstone_segment(segmenter.get(), cloud_of(random_cloud(1000, 1)), result.get(), nullptr);
    EXPECT_GT(io::blocks, before);
  }

  EXPECT_EQ(io::blocks, before);
}

TEST_P(CAllocation, AScanWithoutMemoryIsAnErrorAndTheNextIsSegmented) {
  const OwnedSegmenter segmenter = segmenter_of(GetParam());
  const OwnedSegmentation result = empty_segmentation();
  const std::vector<Point> points = random_cloud(9000, 1);
  flagstone_error error;

  EXPECT_EQ(without_memory([&] {
              return flagstone_segment(segmenter.get(), cloud_of(points), result.get(), &error);
            }),
            FLAGSTONE_OUT_OF_MEMORY);
  EXPECT_STREQ(error.message, "not enough memory");
  EXPECT_EQ(flagstone_segmentation_size(result.get()), 0U);
  EXPECT_EQ(flagstone_segment(segmenter.get(), cloud_of(points), result.get(), &error),
            FLAGSTONE_OK);
  EXPECT_EQ(flagstone_segmentation_size(result.get()), points.size());
}

TEST(CAllocationOf, AHandleWithoutMemoryIsAnError) {
  const tests::OwnedSettings existing = tests::settings_of("surface");
  flagstone_settings* settings = nullptr;
  flagstone_segmenter* segmenter = nullptr;
  flagstone_segmentation* result = nullptr;

  EXPECT_EQ(
      without_memory([&] { return flagstone_settings_create("surface", &settings, nullptr); }),
      FLAGSTONE_OUT_OF_MEMORY);
  EXPECT_EQ(without_memory([&] {
              return flagstone_segmenter_create_with(existing.get(), 1, &segmenter, nullptr);
            }),
            FLAGSTONE_OUT_OF_MEMORY);
  EXPECT_EQ(without_memory([&] { return flagstone_segmentation_create(&result, nullptr); }),
            FLAGSTONE_OUT_OF_MEMORY);

  EXPECT_EQ(settings, nullptr);
  EXPECT_EQ(segmenter, nullptr);
  EXPECT_EQ(result, nullptr);
}

}  // namespace
}  // namespace flagstone
