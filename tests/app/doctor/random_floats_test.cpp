// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cstdint>
#include <vector>

#include "app/doctor/diagnosis.hpp"
#include "app/doctor/examination.hpp"
#include "app/doctor/street_scan.hpp"
#include "library/core/random.hpp"

namespace flagstone::doctor {
namespace {

float any_float(Random& random) {
  return std::bit_cast<float>(static_cast<std::uint32_t>(random.bits()));
}

/// Expects that the diagnosis terminates and has findings.
void expect_a_diagnosis(const std::vector<Point>& points) {
  const std::array scans{examine(cloud_of(points))};
  EXPECT_FALSE(diagnose(summarise(scans), {}).findings.empty());
}

TEST(Doctor, DiagnosesAnyFloats) {
  Random random(4);
  for (int round = 0; round < 8; ++round) {
    std::vector<Point> points;
    for (int i = 0; i < 3000; ++i) {
      points.push_back({any_float(random), any_float(random), any_float(random)});
    }
    expect_a_diagnosis(points);
  }
}

TEST(Doctor, DiagnosesFlatAndEqualPoints) {
  expect_a_diagnosis(std::vector<Point>(3000, {1, 2, 3}));
  expect_a_diagnosis(std::vector<Point>(3000, {3e38f, -3e38f, 3e38f}));
  expect_a_diagnosis(std::vector<Point>(3000, {1e-40f, 0, 0}));
  std::vector<Point> line;
  for (int i = 1; i < 3000; ++i) line.push_back({static_cast<float>(i) / 30, 0, -1.7f});
  expect_a_diagnosis(line);
}

}  // namespace
}  // namespace flagstone::doctor
