// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "library/c_api/errors.hpp"

#include <gmock/gmock.h>

#include <array>
#include <cstddef>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "library/c_api/owned_handles.hpp"
#include "random_cloud.hpp"

namespace flagstone {
namespace {

using c_api::guarded;
using testing::StartsWith;
using tests::cloud_of;
using tests::empty_segmentation;
using tests::OwnedSegmentation;
using tests::OwnedSegmenter;
using tests::OwnedSettings;
using tests::random_cloud;
using tests::segmenter_of;
using tests::settings_of;

TEST(CErrors, AreTheExceptionsOfTheCppFunctions) {
  flagstone_error error;

  EXPECT_EQ(guarded(&error, [] { throw std::invalid_argument("x: is wrong"); }),
            FLAGSTONE_INVALID_ARGUMENT);
  EXPECT_STREQ(error.message, "x: is wrong");
  EXPECT_EQ(guarded(&error, [] { throw std::bad_alloc(); }), FLAGSTONE_OUT_OF_MEMORY);
  EXPECT_STREQ(error.message, "not enough memory");
  EXPECT_EQ(guarded(&error, [] { throw std::runtime_error("disk"); }), FLAGSTONE_INTERNAL_ERROR);
  EXPECT_STREQ(error.message, "disk");
  EXPECT_EQ(guarded(&error, [] { throw 1; }), FLAGSTONE_INTERNAL_ERROR);
  EXPECT_STREQ(error.message, "unknown error");
  EXPECT_EQ(guarded(&error, [] {}), FLAGSTONE_OK);
  EXPECT_STREQ(error.message, "");
}

TEST(CErrors, NeedNoBufferForTheMessage) {
  EXPECT_EQ(guarded(nullptr, [] { throw std::bad_alloc(); }), FLAGSTONE_OUT_OF_MEMORY);
}

TEST(CErrors, AreOneLine) {
  flagstone_error error;
  c_api::report(&error, FLAGSTONE_INVALID_ARGUMENT,
                "a\nb\tc\x7f"
                "d");
  EXPECT_STREQ(error.message, "a b c d");
}

TEST(CErrors, AreCutBetweenCharacters) {
  flagstone_error error;
  c_api::report(&error, FLAGSTONE_INVALID_ARGUMENT, std::string(511, 'a'));
  EXPECT_EQ(std::strlen(error.message), 511U);
  c_api::report(&error, FLAGSTONE_INVALID_ARGUMENT, std::string(512, 'a'));
  EXPECT_EQ(std::strlen(error.message), 511U);
  std::string euro(509, 'a');
  euro.append("\xe2\x82\xac");
  c_api::report(&error, FLAGSTONE_INVALID_ARGUMENT, euro);
  EXPECT_EQ(std::strlen(error.message), 509U) << "the last character has three bytes";
}

TEST(CErrors, OfALongNameFromTheCallerAreCut) {
  const OwnedSettings settings = settings_of("surface");
  flagstone_error error;

  EXPECT_EQ(
      flagstone_settings_set_number(settings.get(), std::string(100'000, 'x').c_str(), 1, &error),
      FLAGSTONE_INVALID_ARGUMENT);

  EXPECT_EQ(std::strlen(error.message), 511U);
}

TEST(CErrors, OfAScanLeaveAnEmptyResult) {
  const OwnedSegmenter segmenter = segmenter_of("surface");
  const OwnedSegmentation result = empty_segmentation();
  const std::vector<Point> points = random_cloud(1000, 1);
  const auto segment = [&](flagstone_segmenter* method, const flagstone_cloud& cloud) {
    ASSERT_EQ(flagstone_segment(segmenter.get(), cloud_of(points), result.get(), nullptr),
              FLAGSTONE_OK);
    flagstone_error error;
    EXPECT_EQ(flagstone_segment(method, cloud, result.get(), &error), FLAGSTONE_INVALID_ARGUMENT);
    EXPECT_EQ(flagstone_segmentation_size(result.get()), 0U);
    EXPECT_EQ(flagstone_segmentation_patch_count(result.get()), 0U);
    EXPECT_EQ(flagstone_segmentation_grid_count(result.get()), 0U);
    EXPECT_THAT(error.message, StartsWith(method == nullptr ? "segmenter: is NULL" : "cloud: "));
  };

  segment(segmenter.get(), flagstone_cloud_of_floats(nullptr, 10, 4));
  segment(segmenter.get(), flagstone_cloud_of_floats(&points.front().x, std::size_t{1} << 32U, 4));
  segment(nullptr, cloud_of(points));
}

TEST(CErrors, OfASegmenterNameTheValueAndTheRange) {
  flagstone_segmenter* segmenter = nullptr;
  flagstone_error error;

  EXPECT_EQ(flagstone_segmenter_create("surface", 101, &segmenter, &error),
            FLAGSTONE_INVALID_ARGUMENT);
  EXPECT_STREQ(error.message,
               "surface: sensor_height = 101 is out of range (expected -100 to 100 m)");
  EXPECT_EQ(flagstone_segmenter_create("none", 1, &segmenter, &error), FLAGSTONE_INVALID_ARGUMENT);
  EXPECT_THAT(error.message, StartsWith("no method is named 'none'"));
  const OwnedSettings settings = settings_of("surface");
  EXPECT_EQ(flagstone_segmenter_create_with(settings.get(), 0, &segmenter, &error),
            FLAGSTONE_INVALID_ARGUMENT);
  EXPECT_THAT(error.message, StartsWith("surface: threads = 0"));
  EXPECT_EQ(flagstone_segmenter_create_with(settings.get(), 1025, &segmenter, &error),
            FLAGSTONE_INVALID_ARGUMENT);
}

TEST(CErrors, SetTheHandleToNull) {
  auto* settings = reinterpret_cast<flagstone_settings*>(1);
  auto* segmenter = reinterpret_cast<flagstone_segmenter*>(1);

  EXPECT_NE(flagstone_settings_create("none", &settings, nullptr), FLAGSTONE_OK);
  EXPECT_NE(flagstone_segmenter_create("none", 1, &segmenter, nullptr), FLAGSTONE_OK);

  EXPECT_EQ(settings, nullptr);
  EXPECT_EQ(segmenter, nullptr);
}

TEST(CErrors, NullArgumentsAreErrors) {
  const OwnedSettings settings = settings_of("surface");
  const OwnedSegmenter segmenter = segmenter_of("surface");
  const OwnedSegmentation result = empty_segmentation();
  const std::vector<Point> points = random_cloud(1000, 1);
  flagstone_segment(segmenter.get(), cloud_of(points), result.get(), nullptr);
  flagstone_settings* new_settings = nullptr;
  flagstone_segmenter* new_segmenter = nullptr;
  flagstone_setting setting;
  flagstone_grid grid;
  flagstone_mount mount;
  flagstone_ground_sample sample;
  std::array<float, 2> xy{};
  flagstone_error e;

  EXPECT_EQ(flagstone_settings_create(nullptr, &new_settings, &e), FLAGSTONE_INVALID_ARGUMENT);
  EXPECT_STREQ(e.message, "method: is NULL (expected the name of a method)");
  EXPECT_EQ(flagstone_settings_create("surface", nullptr, &e), FLAGSTONE_INVALID_ARGUMENT);
  EXPECT_STREQ(e.message, "handle: is NULL (expected the address of a pointer)");
  for (const flagstone_status status : {
           flagstone_settings_create_for_preset(nullptr, "default", &new_settings, &e),
           flagstone_settings_create_for_preset("patchwork", nullptr, &new_settings, &e),
           flagstone_settings_create_for_preset("patchwork", "default", nullptr, &e),
           flagstone_settings_create_for_sensor(nullptr, "vlp-16", 1, &new_settings, &e),
           flagstone_settings_create_for_sensor("surface", nullptr, 1, &new_settings, &e),
           flagstone_settings_create_for_sensor("surface", "vlp-16", 1, nullptr, &e),
           flagstone_settings_at(nullptr, 0, &setting, &e),
           flagstone_settings_at(settings.get(), 0, nullptr, &e),
           flagstone_settings_find(nullptr, "max_range", &setting, &e),
           flagstone_settings_find(settings.get(), nullptr, &setting, &e),
           flagstone_settings_find(settings.get(), "max_range", nullptr, &e),
           flagstone_settings_set_number(nullptr, "max_range", 1, &e),
           flagstone_settings_set_number(settings.get(), nullptr, 1, &e),
           flagstone_settings_set_numbers(nullptr, "mount.up", xy.data(), 2, &e),
           flagstone_settings_set_numbers(settings.get(), nullptr, xy.data(), 2, &e),
           flagstone_settings_set_numbers(settings.get(), "mount.up", nullptr, 3, &e),
           flagstone_settings_set_choice(nullptr, "mount.tilt", "off", &e),
           flagstone_settings_set_choice(settings.get(), nullptr, "off", &e),
           flagstone_settings_set_choice(settings.get(), "mount.tilt", nullptr, &e),
           flagstone_segmentation_create(nullptr, &e),
           flagstone_segmentation_sample_ground(nullptr, xy.data(), 1, &sample, &e),
           flagstone_segmentation_sample_ground(result.get(), nullptr, 1, &sample, &e),
           flagstone_segmentation_sample_ground(result.get(), xy.data(), 1, nullptr, &e),
           flagstone_segmentation_ground_heights(nullptr, xy.data(), 1, xy.data(), &e),
           flagstone_segmentation_ground_heights(result.get(), nullptr, 1, xy.data(), &e),
           flagstone_segmentation_ground_heights(result.get(), xy.data(), 1, nullptr, &e),
           flagstone_segmentation_grid(nullptr, 0, &grid, &e),
           flagstone_segmentation_grid(result.get(), 0, nullptr, &e),
           flagstone_segmentation_grid(result.get(), 1000, &grid, &e),
           flagstone_segmenter_create(nullptr, 1, &new_segmenter, &e),
           flagstone_segmenter_create("surface", 1, nullptr, &e),
           flagstone_segmenter_create_with(nullptr, 1, &new_segmenter, &e),
           flagstone_segmenter_create_with(settings.get(), 1, nullptr, &e),
           flagstone_segment(nullptr, cloud_of(points), result.get(), &e),
           flagstone_segment(segmenter.get(), cloud_of(points), nullptr, &e),
           flagstone_segmenter_mount(nullptr, &mount, &e),
           flagstone_segmenter_mount(segmenter.get(), nullptr, &e),
       }) {
    EXPECT_EQ(status, FLAGSTONE_INVALID_ARGUMENT);
  }
}

TEST(CErrors, FunctionsWithoutAStatusReturnNothingForNull) {
  flagstone_settings_destroy(nullptr);
  flagstone_segmenter_destroy(nullptr);
  flagstone_segmentation_destroy(nullptr);
  flagstone_segmenter_reset(nullptr);

  EXPECT_EQ(flagstone_settings_count(nullptr), 0U);
  EXPECT_EQ(flagstone_settings_choice(nullptr, "mount.tilt", 0), nullptr);
  EXPECT_EQ(flagstone_settings_choice(settings_of("surface").get(), nullptr, 0), nullptr);
  EXPECT_EQ(flagstone_segmentation_size(nullptr), 0U);
  EXPECT_EQ(flagstone_segmentation_labels(nullptr), nullptr);
  EXPECT_EQ(flagstone_segmentation_label_count(nullptr, FLAGSTONE_GROUND), 0U);
  EXPECT_EQ(flagstone_segmentation_heights(nullptr), nullptr);
  EXPECT_EQ(flagstone_segmentation_patch_count(nullptr), 0U);
  EXPECT_EQ(flagstone_segmentation_patches(nullptr), nullptr);
  EXPECT_EQ(flagstone_segmentation_grid_count(nullptr), 0U);
}

}  // namespace
}  // namespace flagstone
