// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "app/doctor/beams.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "app/doctor/diagnosis.hpp"
#include "app/doctor/examination.hpp"
#include "app/doctor/street_scan.hpp"
#include "files/io/read_cloud.hpp"
#include "lab/sim/drive.hpp"
#include "lab/sim/noise.hpp"
#include "lab/sim/scan.hpp"
#include "lab/sim/street.hpp"
#include "real_scans.hpp"

namespace flagstone::doctor {
namespace {

/// The upper of two stacked sensors of 32 beams, as on the vehicles of Argoverse 2: 1.97 m above
/// the ground.
Sensor upper_sensor() {
  return {.name = "upper",
          .title = "Velodyne VLP-32C",
          .elevations = {15,     10.333, 7,      4.667,  3.333,  2.333,  1.667,   1.333,
                         1,      0.667,  0.333,  0,      -0.333, -0.667, -1,      -1.333,
                         -1.667, -2,     -2.333, -2.667, -3,     -3.333, -3.667,  -4,
                         -4.667, -5.333, -6.148, -7.254, -8.843, -11.31, -15.639, -25},
          .firings = 1800,
          .min_range = 1,
          .max_range = 200,
          .range_sigma = 0.03,
          .height = 1.97};
}

/// The lower one hangs upside down, 8 cm below.
Sensor lower_sensor() {
  Sensor sensor = upper_sensor();
  sensor.name = "lower";
  std::ranges::reverse(sensor.elevations);
  for (double& elevation : sensor.elevations) elevation = -elevation;
  sensor.height = 1.89;
  return sensor;
}

/// What both see of a street, in a frame whose origin is on the rear axle: 0.33 m above the ground,
/// the sensors 1.35 m ahead of it. `moved`: metres that the vehicle drives during the scan, which
/// its points are corrected for.
std::vector<Point> stacked_scan(double moved) {
  const sim::Scene street = sim::make_street(7);
  std::vector<Point> points;
  for (const Sensor& sensor : {upper_sensor(), lower_sensor()}) {
    const sim::Frame pose = sim::sensor_pose(street.ground(), sensor, 0, -1.6, 0);
    const sim::SimulatedScan scan = sim::simulate(street, sensor, sim::Noise{}, pose, 7);
    for (std::size_t i = 0; i < scan.xyzi.size(); i += 4) {
      const double x = scan.xyzi[i];
      const double y = scan.xyzi[i + 1];
      const double turn = std::atan2(y, x) / (2 * std::numbers::pi);
      points.push_back({static_cast<float>(x + 1.35 + moved * turn), static_cast<float>(y),
                        scan.xyzi[i + 2] + static_cast<float>(sensor.height - 0.33)});
    }
  }
  return points;
}

class StackedSensors : public testing::TestWithParam<double> {};

TEST_P(StackedSensors, AreFoundAboveAnOriginOnTheAxleWithoutRings) {
  const std::array scans{examine(cloud_of(stacked_scan(GetParam())))};

  const Diagnosis diagnosis = diagnose(summarise(scans), {});

  const auto origin = std::ranges::find(diagnosis.findings, "origin", &Finding::id);
  ASSERT_NE(origin, diagnosis.findings.end());
  EXPECT_EQ(origin->severity, Severity::fix);
  EXPECT_THAT(origin->sentence, testing::HasSubstr("The origin is not the sensor"));
  ASSERT_TRUE(diagnosis.advice);
  const Mount& mount = diagnosis.advice->mount;
  EXPECT_NEAR(mount.origin[0], 1.35, 0.05 + GetParam() / 4);
  EXPECT_NEAR(mount.origin[1], 0, 0.05 + GetParam() / 4);
  EXPECT_NEAR(mount.origin[2], 1.60, 0.1);  // between the two
  EXPECT_NEAR(mount.sensor_height, 1.93, 0.1);
}

INSTANTIATE_TEST_SUITE_P(StandingAndDriving, StackedSensors, testing::Values(0, 1));

std::vector<Point> points_of(const tests::RealScan& scan) {
  io::Cloud cloud;
  EXPECT_TRUE(io::read_cloud(scan.points, {}, cloud).ok());
  std::vector<Point> points;
  for (std::size_t i = 0; i < cloud.size(); ++i) points.push_back(cloud.view()[i]);
  return points;
}

TEST(BeamOrigin, IsFoundInAKittiScanWithItsOriginBelowTheGround) {
  const auto scans = tests::real_scans("kitti");
  FLAGSTONE_REQUIRE_SCANS(scans);
  const auto raised =
      changed(points_of(scans.front()), [](Point p) { return Point{p.x, p.y, p.z + 2.73f}; });

  const std::array seen{examine(cloud_of(raised))};
  const Diagnosis diagnosis = diagnose(summarise(seen), {});

  ASSERT_TRUE(seen[0].origin);
  EXPECT_NEAR(seen[0].origin->place[2], 2.73 + 0.21, 0.05);  // where the lasers leave its head
  ASSERT_TRUE(diagnosis.advice);
  EXPECT_EQ(diagnosis.advice->sensor, "hdl-64e");
  EXPECT_NEAR(diagnosis.advice->mount.origin[2], 2.73, 0.05);
  EXPECT_EQ(diagnosis.advice->mount.sensor_height, 1.73f);
}

TEST(BeamOrigin, IsNotMisplacedInRealScans) {
  const auto scans = tests::real_scans();
  FLAGSTONE_REQUIRE_SCANS(scans);
  for (const tests::RealScan& scan : scans) {
    if (scan.points.string().find("ouster") != std::string::npos)
      continue;  // a frame on the ground
    const Examination seen = examine(cloud_of(points_of(scan)));
    EXPECT_FALSE(seen.origin && seen.origin->is_elsewhere()) << scan.points;
  }
}

}  // namespace
}  // namespace flagstone::doctor
