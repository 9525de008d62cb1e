// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "flagstone/baselines/line_fit.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "lab/baselines/line_fit_extraction.hpp"

namespace flagstone {
namespace {

using baselines::GroundLine;
using baselines::Prototype;

constexpr float ground_height = -1.73f;

/// Height as a function of range, the same in all directions.
using Profile = std::function<float(float range)>;

float flat(float /*range*/) { return ground_height; }

/// Ground that rises with `slope`, m/m, beyond 10 m.
Profile ramp(float slope) {
  return [=](float range) { return ground_height + slope * std::max(0.0f, range - 10); };
}

Point point_at(float range, float degrees, float height) {
  const float azimuth = degrees * std::numbers::pi_v<float> / 180;
  return {range * std::cos(azimuth), range * std::sin(azimuth), height};
}

/// A full turn: points every 0.3 m from `begin` to `end`, metres, in the middle of every degree.
std::vector<Point> turn(const Profile& profile, float begin = 2, float end = 40) {
  std::vector<Point> cloud;
  for (int degree = 0; degree < 360; ++degree) {
    for (float range = begin; range < end; range += 0.3f) {
      cloud.push_back(point_at(range, static_cast<float>(degree) + 0.5f, profile(range)));
    }
  }
  return cloud;
}

std::vector<Label> labels_of(const std::vector<Point>& cloud, const LineFitConfig& config = {}) {
  LineFit line_fit(config);
  Segmentation result;
  EXPECT_TRUE(line_fit.segment(CloudView(std::span(cloud)), result).ok());
  return {result.labels().begin(), result.labels().end()};
}

/// Fraction of the points between these ranges labelled ground, 0 to 1.
double ground_fraction(const std::vector<Point>& cloud, const std::vector<Label>& labels,
                       float begin, float end) {
  double count = 0;
  double ground = 0;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const float range = std::hypot(cloud[i].x, cloud[i].y);
    if (range < begin || range > end) continue;
    ++count;
    ground += labels[i] == Label::ground ? 1 : 0;
  }
  return ground / count;
}

std::vector<GroundLine> lines_of(const std::vector<Prototype>& prototypes,
                                 const LineFitConfig& config = {}) {
  std::vector<GroundLine> lines(prototypes.size() / 2 + 1);
  lines.resize(baselines::extract_lines(prototypes, config, lines.data()));
  return lines;
}

/// Prototypes every 0.4 m from `begin` to `end`, metres.
std::vector<Prototype> prototypes_of(const Profile& profile, float begin, float end) {
  std::vector<Prototype> prototypes;
  for (float range = begin; range < end; range += 0.4f) {
    prototypes.push_back({range, profile(range)});
  }
  return prototypes;
}

TEST(LineFit, FlatGroundIsGround) {
  EXPECT_THAT(labels_of(turn(flat)), testing::Each(Label::ground));
}

TEST(LineFit, FollowsARampBelowTheSlopeThreshold) {
  const std::vector<Point> cloud = turn(ramp(0.25f));

  EXPECT_GT(ground_fraction(cloud, labels_of(cloud), 2, 39), 0.99);
}

TEST(LineFit, RejectsARampAboveTheSlopeThreshold) {
  const std::vector<Point> cloud = turn(ramp(0.35f));
  LineFitConfig steeper;
  steeper.max_slope = 0.4f;

  EXPECT_EQ(ground_fraction(cloud, labels_of(cloud), 2, 9.9f), 1);
  EXPECT_EQ(ground_fraction(cloud, labels_of(cloud), 11, 39), 0);
  EXPECT_GT(ground_fraction(cloud, labels_of(cloud, steeper), 11, 39), 0.99);
}

TEST(LineFit, AKerbStartsANewLine) {
  const auto kerb = [](float range) { return ground_height + (range < 8 ? 0.0f : 0.15f); };

  const std::vector<GroundLine> lines = lines_of(prototypes_of(kerb, 3, 15));

  ASSERT_EQ(lines.size(), 2u);
  EXPECT_LT(lines[0].end, 8);
  EXPECT_NEAR(lines[0].height, ground_height, 1e-5f);
  EXPECT_GE(lines[1].begin, 8);
  EXPECT_NEAR(lines[1].height, ground_height + 0.15f, 1e-5f);
}

TEST(LineFit, AStepAboveMaxStartHeightEndsTheGround) {
  const auto step = [](float range) { return ground_height + (range < 8 ? 0.0f : 0.25f); };

  EXPECT_EQ(lines_of(prototypes_of(step, 3, 15)).size(), 1u);
}

TEST(LineFit, TwoPointsAreNotALine) {
  EXPECT_TRUE(lines_of({{3, ground_height}, {3.4f, ground_height}}).empty());
  EXPECT_EQ(lines_of({{3, ground_height}, {3.4f, ground_height}, {3.8f, ground_height}}).size(),
            1u);
}

TEST(LineFit, AfterALongGapOnlyPointsOnItsExtensionContinueALine) {
  std::vector<Prototype> prototypes = prototypes_of(flat, 3, 4);
  prototypes.push_back({9, ground_height + 0.15f});  // so far away that it would tilt the line
  LineFitConfig loose;
  loose.max_gap_height = 0.2f;

  EXPECT_LT(lines_of(prototypes)[0].end, 4);
  EXPECT_EQ(lines_of(prototypes, loose)[0].end, 9);
}

TEST(LineFit, ALineOfTwoPointsDoesNotCrossALongGap) {
  const std::vector<Prototype> prototypes = {
      {3, ground_height}, {3.4f, ground_height}, {9, ground_height}, {9.4f, ground_height}};
  LineFitConfig longer_gap;
  longer_gap.long_gap = 10;

  EXPECT_TRUE(lines_of(prototypes).empty());
  EXPECT_EQ(lines_of(prototypes, longer_gap).size(), 1u);
}

TEST(LineFit, ABonnetAboveTheLineIsNotGround) {
  std::vector<Point> cloud = turn(flat);
  const std::size_t ground_points = cloud.size();
  for (float range = 5; range < 8; range += 0.3f) cloud.push_back(point_at(range, 30.5f, -0.8f));

  const std::vector<Label> labels = labels_of(cloud);

  EXPECT_THAT(std::vector(labels.begin(), labels.begin() + static_cast<int>(ground_points)),
              testing::Each(Label::ground));
  EXPECT_THAT(std::vector(labels.begin() + static_cast<int>(ground_points), labels.end()),
              testing::Each(Label::nonground));
}

TEST(LineFit, ATableThatHidesTheGroundBelowItIsNotGround) {
  const auto table = [](float range) { return range < 6 || range > 9 ? ground_height : -0.8f; };
  const std::vector<Point> cloud = turn(table);

  const std::vector<Label> labels = labels_of(cloud);

  EXPECT_EQ(ground_fraction(cloud, labels, 6, 9), 0);
  EXPECT_EQ(ground_fraction(cloud, labels, 2, 5.9f), 1);
  EXPECT_EQ(ground_fraction(cloud, labels, 9.1f, 39), 1);
}

TEST(LineFit, TheInterceptThresholdRejectsAPlateau) {
  const auto plateau = [](float range) { return range < 8 ? ground_height : ground_height + 0.8f; };
  const std::vector<Prototype> prototypes = prototypes_of(plateau, 3, 15);
  LineFitConfig config;
  config.max_start_height = 1;  // so that max_start_height does not reject it
  LineFitConfig without = config;
  without.max_intercept = std::numeric_limits<float>::infinity();

  ASSERT_EQ(lines_of(prototypes, config).size(), 1u);
  EXPECT_LT(lines_of(prototypes, config)[0].end, 8);
  EXPECT_EQ(lines_of(prototypes, without).size(), 2u);
}

TEST(LineFit, TheInterceptOfALineThatIsNotFlatIsNotCompared) {
  LineFitConfig config;
  config.max_start_height = 1;
  // Extended to the sensor, the line is 0.75 m below the ground.
  const auto rising = [](float range) { return ground_height - 0.75f + 0.05f * range; };

  EXPECT_EQ(lines_of(prototypes_of(rising, 3, 12), config).size(), 1u);
  config.flat_slope = 0.1f;
  EXPECT_TRUE(lines_of(prototypes_of(rising, 3, 12), config).empty());
}

TEST(LineFit, ASegmentWithoutALineUsesItsNeighbours) {
  std::vector<Point> cloud = turn(flat);
  std::erase_if(cloud, [](const Point& p) { return p.x > 0 && p.y > 0 && p.y < p.x * 0.034f; });
  cloud.push_back(point_at(20, 0.5f, ground_height + 0.02f));
  cloud.push_back(point_at(25, 0.5f, ground_height + 0.2f));
  LineFitConfig own_segment_only;
  own_segment_only.search_angle = 0;

  const std::vector<Label> labels = labels_of(cloud);

  EXPECT_EQ(labels[cloud.size() - 2], Label::ground);
  EXPECT_EQ(labels.back(), Label::nonground);
  EXPECT_EQ(labels_of(cloud, own_segment_only)[cloud.size() - 2], Label::nonground);
}

TEST(LineFit, TheSearchForLinesWrapsAroundAFullTurn) {
  std::vector<Point> cloud = turn(flat);
  std::erase_if(cloud, [](const Point& p) { return p.x < 0 && p.y < 0; });  // azimuth -180 to -90
  cloud.push_back(point_at(20, -179.5f, ground_height));

  EXPECT_EQ(labels_of(cloud).back(), Label::ground);
}

TEST(LineFit, PointsOutsideTheGridAreOutOfRange) {
  const std::vector<Label> labels =
      labels_of({{0.3f, 0.3f, ground_height}, {0, -0.6f, ground_height}, {36, 36, ground_height}});

  EXPECT_EQ(labels, (std::vector{Label::out_of_range, Label::nonground, Label::out_of_range}));
}

TEST(LineFit, EveryLineSatisfiesItsThresholds) {
  EXPECT_TRUE(rc::check([](const std::vector<std::uint8_t>& steps) {
    std::vector<Prototype> prototypes;
    float range = 2;
    for (const std::uint8_t step : steps) {
      range += 0.2f + 0.05f * static_cast<float>(step % 8);
      prototypes.push_back({range, ground_height + 0.01f * static_cast<float>(step / 8)});
    }
    const LineFitConfig config;

    float end = 0;
    for (const GroundLine& line : lines_of(prototypes)) {
      RC_ASSERT(line.begin >= end);
      RC_ASSERT(line.end > line.begin);
      RC_ASSERT(std::abs(line.slope) <= config.max_slope);
      for (const Prototype& p : prototypes) {
        if (p.range < line.begin || p.range > line.end) continue;
        RC_ASSERT(std::abs(p.height - line.height_at(p.range)) <= config.max_fit_error);
      }
      end = line.end;
    }
  }));
}

TEST(LineFit, RejectsInconsistentSettings) {
  LineFitConfig inside_out;
  inside_out.max_range = 0.4f;
  LineFitConfig many_bins;
  many_bins.bins = 200;

  EXPECT_THROW(LineFit{inside_out}, std::invalid_argument);
  EXPECT_THROW(LineFit{many_bins}, std::invalid_argument);
}

}  // namespace
}  // namespace flagstone
