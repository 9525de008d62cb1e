// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "library/moving_points/scan_points.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <random>
#include <span>
#include <string>
#include <vector>

#include "forced_target.hpp"

namespace flagstone {
namespace {

using testing::ElementsAre;

const ScanPointsRule rule{
    .to_world = {1, 0, 0, 0, 1, 0},
    .max_range = 80,
    .min_height = 0.3F,
    .max_height = 3,
    .objects = {.offset_x = 102.4F, .offset_y = 102.4F, .per_metre = 2.5F, .width = 512},
    .columns = {.offset_x = 41, .offset_y = 41, .per_metre = 2, .width = 164},
    .surroundings = {.offset_x = 102, .offset_y = 102, .per_metre = 2, .width = 408}};

/// A scan, point by point.
struct Scan {
  Scan& add(float x, float y, float z, Label label, float height) {
    xyz.insert(xyz.end(), {x, y, z});
    labels.push_back(label);
    heights.push_back(height);
    return *this;
  }
  [[nodiscard]] ScanPoints read() const {
    ScanPoints points;
    points.read({xyz.data(), labels.size()}, labels, heights, rule);
    return points;
  }

  std::vector<float> xyz;
  std::vector<Label> labels;
  std::vector<float> heights;
};

constexpr float unknown = std::numeric_limits<float>::quiet_NaN();

TEST(ScanPoints, PointsOnObjectsInRangeCanMove) {
  const ScanPoints points = Scan()
                                .add(10, 0, 0, Label::nonground, 1)
                                .add(10, 0, 0, Label::ground, 1)
                                .add(10, 0, 0, Label::nonground, 0.3F)  // too low
                                .add(10, 0, 0, Label::nonground, 3)
                                .add(10, 0, 0, Label::nonground, 3.1F)  // too high
                                .add(81, 0, 0, Label::nonground, 1)     // too far
                                .add(10, 0, 0, Label::nonground, unknown)
                                .read();
  EXPECT_THAT(points.candidates(), ElementsAre(0, 3, 6));
  const std::uint32_t column = rule.objects.column_at(10, 0);
  EXPECT_THAT(points.candidate_columns(), ElementsAre(column, column, column));
  const std::uint32_t around = rule.surroundings.column_at(10, 0);
  EXPECT_THAT(points.candidate_surroundings(), ElementsAre(around, around, around));
}

TEST(ScanPoints, HashesDependOnTheCoordinatesAlone) {
  const ScanPoints points = Scan()
                                .add(10, 0, 0, Label::nonground, 1)
                                .add(10, 0, 0.01F, Label::nonground, 1)
                                .add(10, 0, 0, Label::nonground, 2)
                                .read();
  const std::span<const std::uint32_t> hashes = points.candidate_hashes();
  EXPECT_EQ(hashes[0], hashes[2]);
  EXPECT_NE(hashes[0], hashes[1]);
}

TEST(ScanPoints, GroundAndLowObjectsNearTheSensorAreCountedInColumns) {
  const ScanPoints points = Scan()
                                .add(3, 4, -1, Label::ground, 0)
                                .add(3, 4, 0, Label::nonground, 1)
                                .add(3, 4, -1, Label::nonground, 0.2F)  // could be ground
                                .add(3, 4, 1, Label::nonground, 2.5F)   // could be a bridge
                                .add(40, 4, -1, Label::ground, 0)       // too far
                                .add(3, 4, -1, Label::noise, -1)
                                .read();
  const std::uint32_t column = rule.columns.column_at(3, 4);
  const std::uint32_t outside = 2 * rule.columns.outside();
  EXPECT_THAT(points.in_columns(),
              ElementsAre(2 * column, 2 * column + 1, outside, outside, outside, outside));
}

TEST(ScanPoints, MovingPointsAreNotPartOfStaticObjects) {
  ScanPoints points =
      Scan().add(3, 4, 0, Label::nonground, 1).add(3, 4, 0, Label::nonground, 1).read();
  EXPECT_THAT(points.is_object(), ElementsAre(1, 1));
  points.mark_moving(1);
  EXPECT_THAT(points.is_object(), ElementsAre(1, 0));
  EXPECT_EQ(points.in_columns()[1], 2 * rule.columns.outside());
}

TEST(ScanPoints, PointsWithoutAMeasurementAreAtTheSensor) {
  const ScanPoints points = Scan()
                                .add(unknown, 1, 2, Label::invalid, unknown)
                                .add(5, 1, -9, Label::noise, -7)
                                .add(5, 1, 2, Label::out_of_range, unknown)
                                .read();
  EXPECT_EQ(points.points()[0].x, 0);
  EXPECT_EQ(points.points()[1].z, 0);
  EXPECT_EQ(points.points()[2].z, 2);
}

// All output as bytes.
std::vector<std::uint32_t> bits_of(const ScanPoints& points) {
  std::vector<std::uint32_t> bits(points.candidates().begin(), points.candidates().end());
  for (const auto numbers :
       {points.candidate_columns(), points.candidate_surroundings(), points.candidate_hashes()}) {
    bits.insert(bits.end(), numbers.begin(), numbers.end());
  }
  for (std::size_t k = 0; k < points.points().size(); ++k) {
    const Point p = points.points()[k];
    for (const float number : {p.x, p.y, p.z}) bits.push_back(std::bit_cast<std::uint32_t>(number));
    bits.push_back(points.is_object()[k]);
    bits.push_back(points.in_columns()[k]);
  }
  return bits;
}

TEST(ScanPoints, HasTheSameBitsOnEveryInstructionSet) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> position(-120, 120);
  std::uniform_real_distribution<float> height(-1, 4);
  Scan scan;
  for (int k = 0; k < 1013; ++k) {
    scan.add(position(random), position(random), height(random), static_cast<Label>(k % 5),
             k % 7 == 0 ? unknown : height(random));
  }
  const std::vector<std::uint32_t> expected = bits_of(scan.read());
  EXPECT_GT(scan.read().candidates().size(), 20U);
  for (const std::string& target : simd_targets()) {
    const tests::ForcedTarget forced(target);
    EXPECT_EQ(bits_of(scan.read()), expected) << target;
  }
}

}  // namespace
}  // namespace flagstone
