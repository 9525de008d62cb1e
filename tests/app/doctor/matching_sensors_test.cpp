// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "app/doctor/matching_sensors.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace flagstone::doctor {
namespace {

/// What scans of a sensor show if every beam brings something back.
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

TEST(MatchingSensors, BeginWithTheSensorItself) {
  for (const Sensor& sensor : Sensor::known()) {
    const std::vector<std::string> names = names_for(scans_of(sensor));
    ASSERT_FALSE(names.empty()) << sensor.name;
    EXPECT_EQ(names.front(), sensor.name);
  }
}

TEST(MatchingSensors, BearASkyThatBringsNothingBack) {
  Summary summary = scans_of(Sensor::named("hdl-32e"));
  summary.view.top = 3;
  summary.view.beams = 31;

  EXPECT_THAT(names_for(summary), testing::ElementsAre("hdl-32e"));
}

TEST(MatchingSensors, HaveAsManyBeams) {
  Summary summary = scans_of(Sensor::named("vlp-16"));
  summary.view.beams = 32;

  EXPECT_THAT(names_for(summary), testing::IsEmpty());
}

TEST(MatchingSensors, LookAsWide) {
  Summary summary = scans_of(Sensor::named("at128"));
  summary.view.azimuth_width = 360;

  EXPECT_THAT(names_for(summary), testing::IsEmpty());
}

TEST(MatchingSensors, ReachAsFar) {
  Summary summary = scans_of(Sensor::named("vlp-16"));
  summary.reach = 180;

  EXPECT_THAT(names_for(summary), testing::IsEmpty());
}

}  // namespace
}  // namespace flagstone::doctor
