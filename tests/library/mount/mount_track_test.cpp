// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
// The state that is kept between scans.
#include <gtest/gtest.h>

#include <memory>
#include <span>
#include <vector>

#include "flagstone/gravity_aligned_segmenter.hpp"
#include "library/mount/recording_method.hpp"
#include "library/mount/yard.hpp"

namespace flagstone {
namespace {

using tests::level_ground;
using tests::RecordingMethod;

/// A gravity-aligned method that gets one scan after another.
class Asked {
 public:
  explicit Asked(const MountSettings& settings)
      : levelled_(std::make_unique<RecordingMethod>(seen_), 1.73f, settings) {}

  /// The status of a scan of level ground `height` metres below the sensor; 0 for an empty scan.
  MountVerdict about(float height) {
    const std::vector<Point> points = height > 0 ? level_ground(height) : std::vector<Point>();
    Segmentation result;
    EXPECT_TRUE(levelled_.segment(CloudView(std::span<const Point>(points)), result).ok());
    return levelled_.decision().verdict;
  }
  [[nodiscard]] float height() const { return levelled_.mount().sensor_height; }
  /// z of the ground in the last scan, as the method received it.
  [[nodiscard]] float ground() const { return seen_.points.front().z; }
  void reset() { levelled_.reset(); }

 private:
  RecordingMethod::Seen seen_;
  GravityAlignedSegmenter levelled_;
};

TEST(EstimatedPose, IsTheFirstAcceptedEstimate) {
  Asked asked({.height = HeightSource::estimate});

  EXPECT_EQ(asked.about(0), MountVerdict::too_few_points);
  EXPECT_EQ(asked.height(), 1.73f);
  EXPECT_EQ(asked.about(1.2f), MountVerdict::accepted);
  EXPECT_NEAR(asked.height(), 1.2f, 0.001f);
  EXPECT_NEAR(asked.ground(), -1.73f, 0.001f);  // this scan is already transformed
  EXPECT_EQ(asked.about(2.0f), MountVerdict::fixed);
  EXPECT_NEAR(asked.height(), 1.2f, 0.001f);
}

TEST(EstimatedPose, KeepsTheHeightIfOnlyTheTiltIsEstimated) {
  MountSettings settings{.tilt = TiltSource::estimate};
  settings.mount.sensor_height = 1.9f;
  Asked asked(settings);

  EXPECT_EQ(asked.about(1.2f), MountVerdict::accepted);

  EXPECT_EQ(asked.height(), 1.9f);
}

TEST(EstimatedPose, IsClearedByReset) {
  Asked asked({.height = HeightSource::estimate});
  asked.about(1.2f);

  asked.reset();

  EXPECT_EQ(asked.height(), 1.73f);
  EXPECT_EQ(asked.about(2.0f), MountVerdict::accepted);
  EXPECT_NEAR(asked.height(), 2.0f, 0.001f);
}

TEST(TrackedPose, IsTheMeanOfTheFirstEstimates) {
  Asked asked({.height = HeightSource::track});

  for (const float height : {1.70f, 1.76f, 1.73f, 1.77f}) asked.about(height);

  EXPECT_NEAR(asked.height(), 1.74f, 0.002f);
}

TEST(TrackedPose, FollowsASlowChange) {
  Asked asked({.height = HeightSource::track, .tracking = {.window = 5}});

  for (int i = 0; i <= 60; ++i) {
    EXPECT_EQ(asked.about(1.5f + 0.01f * static_cast<float>(i)), MountVerdict::accepted) << i;
  }

  EXPECT_NEAR(asked.height(), 2.1f, 0.06f);  // the mean lags by some scans
}

TEST(TrackedPose, RejectsAnOutlier) {
  Asked asked({.height = HeightSource::track});
  for (int i = 0; i < 5; ++i) asked.about(1.7f);

  EXPECT_EQ(asked.about(2.3f), MountVerdict::outlier);

  EXPECT_NEAR(asked.height(), 1.7f, 0.001f);
  EXPECT_NEAR(asked.ground(), -2.3f + (1.7f - 1.73f), 0.002f);
  EXPECT_EQ(asked.about(1.7f), MountVerdict::accepted);
}

TEST(TrackedPose, AcceptsManyConsecutiveOutliersThatAgree) {
  Asked asked({.height = HeightSource::track, .tracking = {.patience = 4}});
  for (int i = 0; i < 5; ++i) asked.about(1.7f);

  for (int i = 0; i < 3; ++i) EXPECT_EQ(asked.about(2.3f), MountVerdict::outlier) << i;
  EXPECT_EQ(asked.about(2.3f), MountVerdict::accepted);

  EXPECT_NEAR(asked.height(), 2.3f, 0.001f);
}

TEST(TrackedPose, NeverAcceptsOutliersThatDisagree) {
  Asked asked({.height = HeightSource::track, .tracking = {.patience = 3}});
  for (int i = 0; i < 5; ++i) asked.about(1.7f);

  for (int i = 0; i < 6; ++i) {
    EXPECT_EQ(asked.about(i % 2 == 0 ? 2.3f : 1.0f), MountVerdict::outlier) << i;
  }

  EXPECT_NEAR(asked.height(), 1.7f, 0.001f);
}

TEST(TrackedPose, KeepsItsStateOnScansWithoutAnEstimate) {
  Asked asked({.height = HeightSource::track});
  asked.about(2.0f);

  EXPECT_EQ(asked.about(0), MountVerdict::too_few_points);

  EXPECT_NEAR(asked.height(), 2.0f, 0.001f);
}

TEST(TrackedPose, IsClearedByReset) {
  Asked asked({.height = HeightSource::track});
  asked.about(2.0f);

  asked.reset();

  EXPECT_EQ(asked.height(), 1.73f);
  EXPECT_EQ(asked.about(1.4f), MountVerdict::accepted);
  EXPECT_NEAR(asked.height(), 1.4f, 0.001f);
}

}  // namespace
}  // namespace flagstone
