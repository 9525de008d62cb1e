// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "flagstone/flagstone.hpp"
#include "library/c_api/owned_handles.hpp"
#include "numbers.hpp"
#include "random_cloud.hpp"

namespace flagstone {
namespace {

using tests::cloud_of;
using tests::corrupted_cloud;
using tests::empty_segmentation;
using tests::OwnedSegmentation;
using tests::random_cloud;
using tests::segmenter_of;
using tests::view_of;

bool same_bits(float a, float b) {
  return std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b);
}

OwnedSegmentation segmented_by(const char* method, const std::vector<Point>& points) {
  OwnedSegmentation result = empty_segmentation();
  EXPECT_EQ(flagstone_segment(segmenter_of(method).get(), cloud_of(points), result.get(), nullptr),
            FLAGSTONE_OK);
  return result;
}

TEST(CSegmentation, IsEmptyBeforeTheFirstScan) {
  const OwnedSegmentation result = empty_segmentation();

  EXPECT_EQ(flagstone_segmentation_size(result.get()), 0U);
  EXPECT_EQ(flagstone_segmentation_labels(result.get()), nullptr);
  EXPECT_EQ(flagstone_segmentation_heights(result.get()), nullptr);
  EXPECT_EQ(flagstone_segmentation_patch_count(result.get()), 0U);
  EXPECT_EQ(flagstone_segmentation_patches(result.get()), nullptr);
  EXPECT_EQ(flagstone_segmentation_grid_count(result.get()), 0U);
}

TEST(CSegmentation, CountsTheLabels) {
  const OwnedSegmentation result = segmented_by("surface", corrupted_cloud(20000, 1));
  std::array<std::size_t, FLAGSTONE_LABEL_COUNT> counts{};
  for (std::size_t i = 0; i < flagstone_segmentation_size(result.get()); ++i) {
    ++counts.at(flagstone_segmentation_labels(result.get())[i]);
  }

  for (flagstone_label label = 0; label < FLAGSTONE_LABEL_COUNT; ++label) {
    EXPECT_GT(counts.at(label), 0U) << flagstone_label_name(label);
    EXPECT_EQ(flagstone_segmentation_label_count(result.get(), label), counts.at(label));
  }
  EXPECT_EQ(flagstone_segmentation_label_count(result.get(), FLAGSTONE_LABEL_COUNT), 0U);
  EXPECT_EQ(flagstone_segmentation_label_count(result.get(), 255), 0U);
}

TEST(CSegmentation, SamplesTheGroundAsTheCppSurfaceDoes) {
  const std::vector<Point> points = random_cloud(60000, 2);
  Surface method;
  Segmentation reference;
  ASSERT_TRUE(method.segment(view_of(points), reference).ok());
  const OwnedSegmentation result = segmented_by("surface", points);
  const std::vector<float> xy = {0, 0, 10, 0, -7.3f, 12.9f, 1000, 0, nan, 3, 4, inf};
  const std::size_t count = xy.size() / 2;
  std::vector<flagstone_ground_sample> samples(count);
  std::vector<float> heights(count);

  ASSERT_EQ(
      flagstone_segmentation_sample_ground(result.get(), xy.data(), count, samples.data(), nullptr),
      FLAGSTONE_OK);
  ASSERT_EQ(flagstone_segmentation_ground_heights(result.get(), xy.data(), count, heights.data(),
                                                  nullptr),
            FLAGSTONE_OK);

  for (std::size_t i = 0; i < count; ++i) {
    const GroundSample expected = reference.surface().at(xy[2 * i], xy[2 * i + 1]);
    const flagstone_ground_sample& found = samples[i];
    EXPECT_TRUE(same_bits(found.height, expected.height)) << i;
    EXPECT_TRUE(same_bits(heights[i], expected.height)) << i;
    EXPECT_TRUE(same_bits(found.slope, expected.slope)) << i;
    EXPECT_TRUE(same_bits(found.confidence, expected.confidence)) << i;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      EXPECT_TRUE(same_bits(found.normal[axis], expected.normal.at(axis))) << i;
    }
  }
  EXPECT_TRUE(std::isfinite(heights[1]));
  EXPECT_TRUE(std::isnan(heights[3]));
}

TEST(CSegmentation, OfPatchworkHasNoHeightsAndAnUnknownGround) {
  const OwnedSegmentation result = segmented_by("patchwork", random_cloud(20000, 3));
  const std::array<float, 2> xy = {10, 0};
  flagstone_ground_sample sample{};
  float height = 0;

  EXPECT_EQ(flagstone_segmentation_sample_ground(result.get(), xy.data(), 1, &sample, nullptr),
            FLAGSTONE_OK);
  EXPECT_EQ(flagstone_segmentation_ground_heights(result.get(), xy.data(), 1, &height, nullptr),
            FLAGSTONE_OK);

  EXPECT_TRUE(std::isnan(sample.height));
  EXPECT_TRUE(std::isnan(height));
  EXPECT_EQ(flagstone_segmentation_heights(result.get()), nullptr);
  EXPECT_EQ(flagstone_segmentation_grid_count(result.get()), 0U);
  EXPECT_GT(flagstone_segmentation_patch_count(result.get()), 0U);
}

TEST(CSegmentation, QueriesOfNoPositionNeedNoMemory) {
  const OwnedSegmentation result = segmented_by("surface", random_cloud(1000, 4));

  EXPECT_EQ(flagstone_segmentation_sample_ground(result.get(), nullptr, 0, nullptr, nullptr),
            FLAGSTONE_OK);
  EXPECT_EQ(flagstone_segmentation_ground_heights(result.get(), nullptr, 0, nullptr, nullptr),
            FLAGSTONE_OK);
}

TEST(CNames, EqualTheNamesOfTheCppEnumerations) {
  EXPECT_STREQ(flagstone_label_name(FLAGSTONE_OUT_OF_RANGE), "out_of_range");
  EXPECT_STREQ(flagstone_label_name(5), "unknown");
  EXPECT_STREQ(flagstone_verdict_name(FLAGSTONE_PATCH_NOT_UPRIGHT), "not_upright");
  EXPECT_STREQ(flagstone_verdict_name(65535), "unknown");
  EXPECT_STREQ(flagstone_mount_verdict_name(FLAGSTONE_MOUNT_ONE_SIDED), "one_sided");
  EXPECT_STREQ(flagstone_mount_verdict_name(255), "unknown");
}

}  // namespace
}  // namespace flagstone
