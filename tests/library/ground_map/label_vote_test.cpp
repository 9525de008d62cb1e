// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "flagstone/label_vote.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <random>
#include <stdexcept>
#include <vector>

#include "library/ground_map/ground_scan.hpp"

namespace flagstone {
namespace {

// Scans from one position, each with its labels.
class Position {
 public:
  explicit Position(const LabelVoteConfig& config = {})
      : pose_(upright_pose(level_ground, 0, 0)), scan_(level_ground, pose_, 20), vote_(config) {}

  [[nodiscard]] std::size_t points() const { return scan_.xyz.size() / 3; }
  [[nodiscard]] double range(std::size_t i) const {
    return std::hypot(double{scan_.xyz[3 * i]}, double{scan_.xyz[3 * i + 1]});
  }

  // All points have this label.
  void add(Label label, const Pose& pose = upright_pose(level_ground, 0, 0)) {
    EXPECT_TRUE(vote_.add(scan_.view(), labelled(label), pose, {}).ok());
  }
  [[nodiscard]] std::vector<Label> relabel(Label own) {
    std::vector<Label> labels(points());
    EXPECT_TRUE(vote_.relabel(scan_.view(), labelled(own), pose_, {}, labels).ok());
    return labels;
  }

  [[nodiscard]] LabelVote& vote() { return vote_; }
  [[nodiscard]] GroundScan& scan() { return scan_; }
  [[nodiscard]] const Pose& pose() const { return pose_; }

 private:
  const Segmentation& labelled(Label label) {
    std::ranges::fill(scan_.result.start(points()), label);
    std::ranges::fill(scan_.result.start_heights(), 0.0F);
    return scan_.result;
  }

  Pose pose_;
  GroundScan scan_;
  LabelVote vote_;
};

TEST(LabelVote, TheMajorityOfTheScansDecides) {
  Position position;
  position.add(Label::ground);
  position.add(Label::ground);
  position.add(Label::nonground);

  EXPECT_THAT(position.relabel(Label::nonground), testing::Each(Label::ground));
  EXPECT_THAT(position.relabel(Label::ground), testing::Each(Label::ground));
}

TEST(LabelVote, APointKeepsItsLabelWithoutVotesOrAfterATie) {
  Position position;
  EXPECT_THAT(position.relabel(Label::nonground), testing::Each(Label::nonground));
  position.add(Label::ground);
  position.add(Label::nonground);

  EXPECT_THAT(position.relabel(Label::nonground), testing::Each(Label::nonground));
  EXPECT_THAT(position.relabel(Label::ground), testing::Each(Label::ground));
}

TEST(LabelVote, OtherLabelsNeverChangeAndDoNotVote) {
  for (const Label label : {Label::noise, Label::out_of_range, Label::invalid}) {
    Position position;
    position.add(label);
    EXPECT_EQ(position.vote().voxels(), 0U);
    position.add(Label::ground);
    EXPECT_THAT(position.relabel(label), testing::Each(label));
  }
}

TEST(LabelVote, PointsFarAboveTheGroundKeepTheirLabels) {
  Position position;
  position.add(Label::ground);
  std::vector<Label> labels(position.points());
  std::ranges::fill(position.scan().result.start(position.points()), Label::nonground);
  std::ranges::fill(position.scan().result.start_heights(), 1.5F);

  EXPECT_TRUE(
      position.vote()
          .relabel(position.scan().view(), position.scan().result, position.pose(), {}, labels)
          .ok());

  EXPECT_THAT(labels, testing::Each(Label::nonground));
}

TEST(LabelVote, AVoteFromNearbyCountsMoreThanOneFromFar) {
  Position near;
  near.add(Label::ground);
  // The same points, seen from 30 m away.
  Pose far_pose = near.pose();
  far_pose.position[0] -= 30;
  GroundScan far = near.scan();
  for (std::size_t i = 0; i < far.xyz.size(); i += 3) far.xyz[i] += 30;
  std::ranges::fill(far.result.start(near.points()), Label::nonground);
  std::ranges::fill(far.result.start_heights(), 0.0F);
  ASSERT_TRUE(near.vote().add(far.view(), far.result, far_pose, {}).ok());

  const std::vector<Label> labels = near.relabel(Label::nonground);

  for (std::size_t i = 0; i < labels.size(); ++i) {
    if (near.range(i) < 10) {
      ASSERT_EQ(labels[i], Label::ground);
    }
  }
}

TEST(LabelVote, UsesPosesAfterLevelling) {
  Position position;
  position.add(Label::ground);
  position.add(Label::ground);
  // The pose of this scan is 0.5 m too high.
  Pose pose = position.pose();
  pose.position[2] += 0.5;
  std::ranges::fill(position.scan().result.start(position.points()), Label::nonground);
  std::ranges::fill(position.scan().result.start_heights(), 0.0F);
  std::vector<Label> labels(position.points());
  const auto relabel = [&](const Levelling& levelling) {
    EXPECT_TRUE(
        position.vote()
            .relabel(position.scan().view(), position.scan().result, pose, levelling, labels)
            .ok());
    return labels;
  };

  EXPECT_THAT(relabel({}), testing::Each(Label::nonground));
  EXPECT_THAT(relabel({.applied = true, .offset = 0.5}), testing::Each(Label::ground));
}

TEST(LabelVote, LabelsWrittenWithTheVotesAreThoseOfRelabelAfterwards) {
  const Pose pose = upright_pose(level_ground, 3, -7, 0.4);
  GroundScan scan(level_ground, pose, 25);
  const std::size_t points = scan.view().size();
  std::mt19937 random(5);
  LabelVote vote;
  for (int i = 0; i < 4; ++i) {
    for (Label& label : scan.result.start(points)) label = static_cast<Label>(random() % 3);
    for (float& height : scan.result.start_heights()) {
      height = static_cast<float>(random() % 150) / 100;
    }
    std::vector<Label> at_once(points);
    std::vector<Label> afterwards(points);

    ASSERT_TRUE(vote.add(scan.view(), scan.result, pose, {}, at_once).ok());
    ASSERT_TRUE(vote.relabel(scan.view(), scan.result, pose, {}, afterwards).ok());

    EXPECT_EQ(at_once, afterwards);
  }
}

TEST(LabelVote, DoesNotDependOnTheOrderOfPointsOrScans) {
  constexpr std::size_t scans = 6;
  const Pose pose = upright_pose(level_ground, 0, 0);
  std::vector<GroundScan> all(scans, GroundScan(level_ground, pose, 15));
  std::mt19937 random(3);
  for (GroundScan& scan : all) {
    for (Label& label : scan.result.start(scan.xyz.size() / 3)) {
      label = random() % 3 == 0 ? Label::nonground : Label::ground;
    }
    std::ranges::fill(scan.result.start_heights(), 0.0F);
  }
  LabelVote forward;
  LabelVote backward;
  for (const GroundScan& scan : all) {
    ASSERT_TRUE(forward.add(scan.view(), scan.result, pose, {}).ok());
  }
  std::ranges::reverse(all);
  for (const GroundScan& scan : all) {
    GroundScan reversed = scan;
    const std::size_t points = scan.xyz.size() / 3;
    for (std::size_t i = 0; i < points; ++i) {
      for (std::size_t k = 0; k < 3; ++k) {
        reversed.xyz[3 * i + k] = scan.xyz[3 * (points - 1 - i) + k];
      }
    }
    std::ranges::reverse_copy(scan.result.labels(), reversed.result.start(points).begin());
    std::ranges::fill(reversed.result.start_heights(), 0.0F);
    ASSERT_TRUE(backward.add(reversed.view(), reversed.result, pose, {}).ok());
  }

  std::vector<Label> one(all[0].xyz.size() / 3);
  std::vector<Label> other(one.size());
  ASSERT_TRUE(forward.relabel(all[0].view(), all[0].result, pose, {}, one).ok());
  ASSERT_TRUE(backward.relabel(all[0].view(), all[0].result, pose, {}, other).ok());
  EXPECT_EQ(one, other);
}

TEST(LabelVote, ForgetsVoxelsOutsideTheWindow) {
  Position rolling({.window = 100});
  Position everything;
  std::size_t largest = 0;
  for (double x = 0; x < 2000; x += 10) {
    const Pose pose = upright_pose(level_ground, x, 0);
    rolling.add(Label::ground, pose);
    everything.add(Label::ground, pose);
    largest = std::max(largest, rolling.vote().voxels());
  }

  EXPECT_LT(largest, everything.vote().voxels() / 5);
  EXPECT_GT(largest, everything.vote().voxels() / 40);
}

TEST(LabelVote, RejectsOtherSizesAndInvalidPoses) {
  Position position;
  position.add(Label::ground);
  std::vector<Label> few(3);
  Pose invalid = position.pose();
  invalid.rotation[4] = std::nan("");
  const GroundScan& scan = position.scan();

  EXPECT_EQ(position.vote().relabel(scan.view(), scan.result, position.pose(), {}, few).code(),
            StatusCode::invalid_argument);
  EXPECT_EQ(position.vote().add(scan.view(), scan.result, position.pose(), {}, few).code(),
            StatusCode::invalid_argument);
  EXPECT_EQ(position.vote().add(scan.view(), scan.result, invalid, {}).code(),
            StatusCode::invalid_argument);
  EXPECT_EQ(
      position.vote().add(CloudView(scan.xyz.data(), 2), scan.result, position.pose(), {}).code(),
      StatusCode::invalid_argument);
}

TEST(LabelVoteConfig, RejectsValuesOutOfRange) {
  const LabelVoteConfig invalid[] = {{.voxel = 0.01},
                                     {.voxel_height = 2},
                                     {.min_height = -11},
                                     {.max_range = 201},
                                     {.window = 50}};
  for (const LabelVoteConfig& config : invalid) {
    EXPECT_THROW(LabelVote{config}, std::invalid_argument);
  }
}

}  // namespace
}  // namespace flagstone
