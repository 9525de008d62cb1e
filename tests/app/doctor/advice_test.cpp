// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "app/doctor/advice.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "app/doctor/diagnosis.hpp"
#include "app/doctor/examination.hpp"
#include "app/doctor/street_scan.hpp"

namespace flagstone::doctor {
namespace {

Advice advice_for(const io::Cloud& cloud, const Expected& expected = {}) {
  const std::array scans{examine(cloud)};
  const Diagnosis diagnosis = diagnose(summarise(scans), expected);
  EXPECT_TRUE(diagnosis.advice.has_value());
  return diagnosis.advice.value_or(Advice());
}

io::Cloud street_as(const std::function<Point(Point)>& change) {
  return cloud_of(changed(street_scan(), change));
}

TEST(Advice, NamesTheSensor) { EXPECT_EQ(advice_for(cloud_of(street_scan())).sensor, "hdl-64e"); }

TEST(Advice, HasTheMeasuredHeightIfAnotherIsConfigured) {
  const Advice advice = advice_for(cloud_of(street_scan()), {.sensor_height = 2.5f});

  EXPECT_NEAR(advice.mount.sensor_height, 1.73, 0.03);
}

TEST(Advice, KeepsTheConfiguredHeightIfTheGroundIsThere) {
  EXPECT_EQ(advice_for(cloud_of(street_scan()), {.sensor_height = 1.74f}).mount.sensor_height,
            1.74f);
}

TEST(Advice, HasTheBeamOriginIfTheFrameIsOnTheGround) {
  const Mount mount =
      advice_for(street_as([](Point p) { return Point{p.x, p.y, p.z + 1.4f}; })).mount;

  EXPECT_NEAR(mount.origin[2], 1.4, 0.05);
  EXPECT_NEAR(mount.sensor_height, 1.73, 0.05);
}

TEST(Advice, UndoesTheRotationOfAFrame) {
  // z points forward, y down, x to the right, the origin below the ground, in millimetres.
  const Mount mount = advice_for(street_as([](Point p) {
                        return Point{-1000 * p.y, -1000 * (p.z + 2.5f), 1000 * p.x};
                      })).mount;

  EXPECT_THAT(mount.up, testing::ElementsAre(0, -1, 0));
  EXPECT_EQ(mount.scale, 0.001f);
  EXPECT_NEAR(mount.origin[1], -2.5, 0.05);
  EXPECT_NEAR(mount.sensor_height, 1.73, 0.05);
}

TEST(Advice, HasTheUpDirectionOfATiltedFrame) {
  const float sine = std::sin(0.3f);
  const float cosine = std::cos(0.3f);
  const Mount mount = advice_for(street_as([&](Point p) {
                        return Point{p.x * cosine + p.z * sine, p.y, p.z * cosine - p.x * sine};
                      })).mount;

  EXPECT_NEAR(mount.up[0], sine, 0.03);
  EXPECT_NEAR(mount.up[1], 0, 0.05);
  EXPECT_NEAR(mount.up[2], cosine, 0.03);
}

/// The summary of scans of a sensor in which every beam has returns.
Summary scans_of(const Sensor& sensor) {
  Summary summary;
  summary.view = {.beams = sensor.draws_rosette() ? 0 : static_cast<int>(sensor.elevations.size()),
                  .top = sensor.elevations.front(),
                  .bottom = sensor.elevations.back(),
                  .azimuth_begin = sensor.azimuth_begin,
                  .azimuth_width = sensor.azimuth_end - sensor.azimuth_begin};
  summary.reach = sensor.max_range / 2;
  return summary;
}

std::vector<std::string> names_for(const Summary& summary) {
  std::vector<std::string> names;
  for (const Sensor* sensor : matching_sensors(summary)) names.push_back(sensor->name);
  return names;
}

TEST(MatchingSensors, StartWithTheSensorItself) {
  for (const Sensor& sensor : Sensor::known()) {
    const std::vector<std::string> names = names_for(scans_of(sensor));
    ASSERT_FALSE(names.empty()) << sensor.name;
    EXPECT_EQ(names.front(), sensor.name);
  }
}

TEST(MatchingSensors, TolerateMissingReturnsFromTheSky) {
  Summary summary = scans_of(Sensor::named("hdl-32e"));
  summary.view.top = 3;
  summary.view.beams = 31;

  EXPECT_THAT(names_for(summary), testing::ElementsAre("hdl-32e"));
}

TEST(MatchingSensors, HaveTheSameNumberOfBeams) {
  Summary summary = scans_of(Sensor::named("vlp-16"));
  summary.view.beams = 32;

  EXPECT_THAT(names_for(summary), testing::IsEmpty());
}

TEST(MatchingSensors, HaveTheSameFieldOfView) {
  Summary summary = scans_of(Sensor::named("at128"));
  summary.view.azimuth_width = 360;

  EXPECT_THAT(names_for(summary), testing::IsEmpty());
}

TEST(MatchingSensors, HaveTheSameRange) {
  Summary summary = scans_of(Sensor::named("vlp-16"));
  summary.reach = 180;

  EXPECT_THAT(names_for(summary), testing::IsEmpty());
}

TEST(AdviceToml, HasOnlyTheHeightForTheDefaultMount) {
  EXPECT_EQ(to_toml({}),
            "# Settings from 'flagstone doctor'\n"
            "sensor_height = 1.73  # metres above the ground\n");
}

TEST(AdviceToml, HasTheSettingsThatDiffer) {
  Advice advice{.sensor = "os0-128", .has_mount = true};
  advice.mount = {
      .sensor_height = 2, .up = {0, -1, 0}, .origin = {0, 0.25f, -1.5f}, .scale = 0.01f};

  EXPECT_EQ(to_toml(advice),
            "# Settings from 'flagstone doctor'\n"
            "sensor = \"os0-128\"\n"
            "sensor_height = 2.0  # metres above the ground\n"
            "\n[mount]\n"
            "tilt = \"fixed\"\n"
            "up = [0.0, -1.0, 0.0]  # up direction in the cloud's frame\n"
            "origin = [0.0, 0.25, -1.5]  # sensor position in the cloud's frame, metres\n"
            "scale = 0.01  # metres per unit\n");
}

}  // namespace
}  // namespace flagstone::doctor
