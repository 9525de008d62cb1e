// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>
#include <memory>
#include <string>
#include <vector>

#include "flagstone/gravity_aligned_segmenter.hpp"
#include "flagstone/make_segmenter.hpp"
#include "flagstone/version.hpp"
#include "library/c_api/owned_handles.hpp"
#include "outcome.hpp"
#include "random_cloud.hpp"

namespace flagstone {
namespace {

using tests::cloud_of;
using tests::corrupted_cloud;
using tests::empty_segmentation;
using tests::is_same;
using tests::outcome_of;
using tests::OwnedSegmentation;
using tests::OwnedSegmenter;
using tests::OwnedSettings;
using tests::random_cloud;
using tests::segmented;
using tests::segmenter_of;
using tests::segmenter_with;
using tests::settings_of;
using tests::view_of;

TEST(CVersion, EqualsTheVersionOfTheHeaderAndOfTheLibrary) {
  EXPECT_EQ(flagstone_abi_version(), std::uint32_t{FLAGSTONE_ABI_VERSION});
  EXPECT_STREQ(flagstone_version(), FLAGSTONE_VERSION);
}

TEST(CMethods, AreTheMethodsOfTheLibrary) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < flagstone_method_count(); ++i) {
    names.emplace_back(flagstone_method_name(i));
  }

  EXPECT_EQ(names, (std::vector<std::string>{"patchwork", "surface"}));
  EXPECT_EQ(flagstone_method_name(names.size()), nullptr);
}

class CSegmenter : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(AllMethods, CSegmenter, testing::Values("surface", "patchwork"),
                         [](const auto& method) { return std::string(method.param); });

TEST_P(CSegmenter, GivesTheBytesOfTheCppSegmenter) {
  const std::unique_ptr<Segmenter> reference = make_segmenter(GetParam());
  const OwnedSegmenter segmenter = segmenter_of(GetParam());
  const OwnedSegmentation result = empty_segmentation();
  for (const auto& cloud : {random_cloud(20000, 1), corrupted_cloud(20000, 2), std::vector<Point>{},
                            random_cloud(100, 3)}) {
    flagstone_error error;
    ASSERT_EQ(flagstone_segment(segmenter.get(), cloud_of(cloud), result.get(), &error),
              FLAGSTONE_OK)
        << error.message;

    EXPECT_TRUE(is_same(segmented(*reference, view_of(cloud)), outcome_of(*result)));
    EXPECT_STREQ(error.message, "");
  }
}

TEST_P(CSegmenter, ReadsAnyLayout) {
  const std::vector<Point> points = random_cloud(5000, 4);
  std::vector<float> planes(3 * points.size());
  std::vector<float> rows(5 * points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto [x, y, z] = points[i];
    planes[i] = rows[5 * i] = x;
    planes[points.size() + i] = rows[5 * i + 1] = y;
    planes[2 * points.size() + i] = rows[5 * i + 2] = z;
  }
  const auto plane = static_cast<std::ptrdiff_t>(4 * points.size());
  const OwnedSegmenter segmenter = segmenter_of(GetParam());
  const OwnedSegmentation result = empty_segmentation();
  flagstone_segment(segmenter.get(), cloud_of(points), result.get(), nullptr);
  const tests::Outcome expected = outcome_of(*result);

  for (const flagstone_cloud& cloud :
       {flagstone_cloud{planes.data(), points.size(), 4, 0, plane, 2 * plane},
        flagstone_cloud_of_floats(rows.data(), points.size(), 5)}) {
    ASSERT_EQ(flagstone_segment(segmenter.get(), cloud, result.get(), nullptr), FLAGSTONE_OK);
    EXPECT_TRUE(is_same(expected, outcome_of(*result)));
  }
}

TEST_P(CSegmenter, GivesABitIdenticalResultWithThreads) {
  const std::vector<Point> points = random_cloud(30000, 5);
  const OwnedSettings settings = settings_of(GetParam());
  const OwnedSegmenter one = segmenter_with(settings, 1);
  const OwnedSegmenter three = segmenter_with(settings, 3);
  const OwnedSegmentation from_one = empty_segmentation();
  const OwnedSegmentation from_three = empty_segmentation();

  ASSERT_EQ(flagstone_segment(one.get(), cloud_of(points), from_one.get(), nullptr), FLAGSTONE_OK);
  ASSERT_EQ(flagstone_segment(three.get(), cloud_of(points), from_three.get(), nullptr),
            FLAGSTONE_OK);

  EXPECT_TRUE(is_same(outcome_of(*from_one), outcome_of(*from_three)));
}

TEST_P(CSegmenter, UsesTheSensorHeight) {
  std::vector<Point> points = random_cloud(20000, 6);
  for (Point& point : points) point.z -= 2;
  const std::unique_ptr<Segmenter> reference = [] {
    MethodConfig config = default_config(GetParam());
    if (auto* surface = config.get_if<SurfaceConfig>()) surface->sensor_height = 3.73f;
    if (auto* patchwork = config.get_if<PatchworkConfig>()) patchwork->sensor_height = 3.73f;
    return config.make();
  }();
  const OwnedSegmenter segmenter = segmenter_of(GetParam(), 3.73f);
  const OwnedSegmentation result = empty_segmentation();

  ASSERT_EQ(flagstone_segment(segmenter.get(), cloud_of(points), result.get(), nullptr),
            FLAGSTONE_OK);

  EXPECT_TRUE(is_same(segmented(*reference, view_of(points)), outcome_of(*result)));
}

TEST_P(CSegmenter, OutlivesItsSettings) {
  OwnedSettings settings = settings_of(GetParam());
  const OwnedSegmenter segmenter = segmenter_with(settings);
  settings.reset();
  const OwnedSegmentation result = empty_segmentation();
  const std::vector<Point> points = random_cloud(1000, 7);

  EXPECT_EQ(flagstone_segment(segmenter.get(), cloud_of(points), result.get(), nullptr),
            FLAGSTONE_OK);
  EXPECT_EQ(flagstone_segmentation_size(result.get()), points.size());
}

TEST(CMount, IsEstimatedAndForgottenOnReset) {
  const OwnedSettings settings = settings_of("surface");
  ASSERT_EQ(flagstone_settings_set_choice(settings.get(), "mount.height", "estimate", nullptr),
            FLAGSTONE_OK);
  ASSERT_EQ(flagstone_settings_set_choice(settings.get(), "mount.tilt", "estimate", nullptr),
            FLAGSTONE_OK);
  const OwnedSegmenter segmenter = segmenter_with(settings);
  std::vector<Point> points = random_cloud(60000, 8);
  for (Point& point : points) point.z -= 0.5f;
  MountSettings mount{.height = HeightSource::estimate, .tilt = TiltSource::estimate};
  GravityAlignedSegmenter reference(make_segmenter("surface"), 1.73f, mount);
  const tests::Outcome expected = segmented(reference, view_of(points));
  ASSERT_TRUE(reference.decision().accepted());
  const OwnedSegmentation result = empty_segmentation();
  flagstone_mount found;

  ASSERT_EQ(flagstone_segment(segmenter.get(), cloud_of(points), result.get(), nullptr),
            FLAGSTONE_OK);
  ASSERT_EQ(flagstone_segmenter_mount(segmenter.get(), &found, nullptr), FLAGSTONE_OK);

  EXPECT_TRUE(is_same(expected, outcome_of(*result)));
  EXPECT_EQ(found.sensor_height, reference.mount().sensor_height);
  EXPECT_NEAR(found.sensor_height, 2.23f, 0.1f);
  EXPECT_TRUE(std::ranges::equal(found.up, reference.mount().up));
  EXPECT_EQ(found.confidence, reference.decision().confidence);
  EXPECT_STREQ(flagstone_mount_verdict_name(found.verdict), "accepted");

  flagstone_segmenter_reset(segmenter.get());
  ASSERT_EQ(flagstone_segmenter_mount(segmenter.get(), &found, nullptr), FLAGSTONE_OK);
  EXPECT_EQ(found.sensor_height, 1.73f);
  EXPECT_STREQ(flagstone_mount_verdict_name(found.verdict), "fixed");
}

}  // namespace
}  // namespace flagstone
