// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
// On real scans, every method is about as accurate as in independent measurements.
#include <gtest/gtest.h>

#include "mean_f1.hpp"
#include "methods.hpp"

namespace flagstone {
namespace {

/// Tolerance in F1 because the scans differ, percentage points.
constexpr double tolerance = 4;

/// Tests on real scans; the parameter is the method.
class PlausibleAccuracy : public testing::TestWithParam<tests::Method> {};

INSTANTIATE_TEST_SUITE_P(All, PlausibleAccuracy, testing::ValuesIn(tests::methods()),
                         tests::name_of);

TEST_P(PlausibleAccuracy, OnKittiMatchesIndependentMeasurements) {
  const auto scans = tests::real_scans("kitti");
  FLAGSTONE_REQUIRE_SCANS(scans);
  const tests::Method& method = GetParam();
  const auto make = [&](float) { return method.make(); };

  EXPECT_GE(tests::mean_f1(method.name, make, scans, eval::patchwork_protocol()),
            method.f1_patchwork - tolerance);
  EXPECT_GE(tests::mean_f1(method.name, make, scans, eval::patchwork_plusplus_protocol()),
            method.f1_patchwork_plusplus - tolerance);
}

}  // namespace
}  // namespace flagstone
