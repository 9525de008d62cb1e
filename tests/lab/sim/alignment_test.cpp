// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/sim/alignment.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <numbers>
#include <vector>

#include "lab/sim/extent.hpp"

namespace flagstone::sim {
namespace {

std::vector<Alignment> circuits() {
  std::vector<Alignment> all;
  for (const std::size_t stretches : {10U, 14U, 28U, 42U}) {
    for (std::uint64_t seed = 1; seed <= 8; ++seed) {
      all.emplace_back(Extent{.stretches = stretches, .closed = true}, Random(seed));
    }
  }
  return all;
}

std::vector<Alignment> open_lines() {
  std::vector<Alignment> all;
  for (std::uint64_t seed = 1; seed <= 16; ++seed) {
    all.emplace_back(Extent{.stretches = 42}, Random(seed));
  }
  return all;
}

double distance(const Stop& one, const Stop& other) {
  return std::hypot(other.x - one.x, other.y - one.y);
}

TEST(Alignment, CircuitEndsWhereItBegins) {
  for (const Alignment& line : circuits()) {
    const double begin = line.extent().begin();
    const double end = line.extent().end();
    // Just before the end and just behind it, so that both ends of the table are used.
    const Stop before = line.at(end - 1e-6);
    const Stop behind = line.at(begin + 1e-6);

    EXPECT_NEAR(distance(before, behind), 2e-6, 1e-7);
    EXPECT_NEAR(behind.yaw + 2 * std::numbers::pi, line.at(end - 1e-9).yaw, 1e-6);
    EXPECT_NEAR(line.height(begin), line.height(end), 1e-9);
    EXPECT_NEAR(distance(line.at(begin + 100), line.at(end + 100)), 0, 1e-9) << "second lap";
  }
}

TEST(Alignment, DistanceAlongTheLineIsTheSameAsInRoadCoordinates) {
  for (const Alignment& line : open_lines()) {
    double way = 0;
    for (double x = 0; x < 1000; ++x) way += distance(line.at(x), line.at(x + 1));
    EXPECT_NEAR(way, 1000, 0.01);
  }
}

TEST(Alignment, LandNextToTheLineNeverFoldsInACurve) {
  std::vector<Alignment> lines = circuits();
  std::ranges::copy(open_lines(), std::back_inserter(lines));
  for (const Alignment& line : lines) {
    for (double x = line.extent().begin(); x < line.extent().end(); x += 2) {
      const Stop at = line.at(x);
      for (const double t : {-alignment_half_width, alignment_half_width}) {
        const Vector3 step = line.to_world(Vector3{x + 2, t, 0}) - line.to_world(Vector3{x, t, 0});
        EXPECT_GT(step.x * std::cos(at.yaw) + step.y * std::sin(at.yaw), 0.1) << "x " << x;
      }
    }
  }
}

TEST(Alignment, LandOfDistantPartsDoesNotOverlap) {
  constexpr double apart = 300;  // metres along the line, more than half a turn of a narrow curve
  for (const auto& lines : {circuits(), open_lines()}) {
    for (const Alignment& line : lines) {
      const Extent& extent = line.extent();
      for (double x = extent.begin(); x < extent.end(); x += 8) {
        for (double other = x + apart; other < extent.end(); other += 8) {
          if (extent.closed && x + extent.length() - other < apart) break;
          EXPECT_GT(distance(line.at(x), line.at(other)), 2 * alignment_half_width);
        }
      }
    }
  }
}

TEST(Alignment, GradesAreAtMostSixPercent) {
  for (const Alignment& line : circuits()) {
    double steepest = 0;
    for (double x = 0; x < line.extent().length(); ++x) {
      steepest = std::max(steepest, std::abs(line.height(x + 1) - line.height(x)));
    }
    EXPECT_LE(steepest, 0.06);
    EXPECT_GE(steepest, 0.01);
  }
}

}  // namespace
}  // namespace flagstone::sim
