// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "flagstone/sensor.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <stdexcept>
#include <string>
#include <utility>

#include "numbers.hpp"

namespace flagstone {
namespace {

using testing::HasSubstr;

std::string refusal_of(const std::function<void(Sensor&)>& spoil) {
  Sensor sensor = Sensor::named("vlp-16");
  spoil(sensor);
  try {
    sensor.check();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "accepted";
}

TEST(Sensor, EveryKnownSensorPassesTheCheck) {
  ASSERT_EQ(Sensor::known().size(), 8);
  for (const Sensor& sensor : Sensor::known()) EXPECT_NO_THROW(sensor.check()) << sensor.name;
}

TEST(Sensor, HasTheNumberOfBeamsInItsName) {
  EXPECT_EQ(Sensor::named("hdl-64e").elevations.size(), 64);
  EXPECT_EQ(Sensor::named("hdl-32e").elevations.size(), 32);
  EXPECT_EQ(Sensor::named("vlp-16").elevations.size(), 16);
  EXPECT_EQ(Sensor::named("pandar64").elevations.size(), 64);
  EXPECT_EQ(Sensor::named("os0-128").elevations.size(), 128);
  EXPECT_EQ(Sensor::named("os1-64").elevations.size(), 64);
  EXPECT_EQ(Sensor::named("at128").elevations.size(), 128);
}

TEST(Sensor, SeesAllAroundUnlessItsFieldOfViewIsNarrow) {
  EXPECT_TRUE(Sensor::named("vlp-16").sees_all_around());
  EXPECT_FALSE(Sensor::named("at128").sees_all_around());
  EXPECT_TRUE(Sensor::named("livox-avia").draws_rosette());
  EXPECT_FALSE(Sensor::named("at128").draws_rosette());
}

TEST(Sensor, RejectsAnUnknownNameAndListsTheKnownSensors) {
  try {
    (void)Sensor::named("vlp-17");
    FAIL() << "accepted";
  } catch (const std::invalid_argument& error) {
    EXPECT_THAT(error.what(),
                testing::AllOf(HasSubstr("no sensor is named 'vlp-17' (expected hdl-64e"),
                               HasSubstr("; did you mean 'vlp-16'?)")));
  }
}

TEST(Sensor, NamesTheFieldThatIsOutOfRange) {
  EXPECT_THAT(refusal_of([](Sensor& s) { s.elevations.clear(); }),
              HasSubstr("sensor vlp-16: number of elevations = 0 is out of range (expected 1 to"));
  EXPECT_THAT(refusal_of([](Sensor& s) { s.elevations[2] = nan; }), HasSubstr("elevations[2]"));
  EXPECT_THAT(refusal_of([](Sensor& s) { std::swap(s.elevations[0], s.elevations[1]); }),
              HasSubstr("elevations are not in descending order"));
  EXPECT_THAT(refusal_of([](Sensor& s) { s.firings = 0; }), HasSubstr("firings = 0"));
  EXPECT_THAT(refusal_of([](Sensor& s) { s.azimuth_end = 0; }), HasSubstr("azimuth_end = 0"));
  EXPECT_THAT(refusal_of([](Sensor& s) { s.azimuth_begin = -10; }), HasSubstr("azimuth_end = 360"));
  EXPECT_THAT(refusal_of([](Sensor& s) { s.rosette = {1}; }), HasSubstr("length of rosette = 1"));
  EXPECT_THAT(refusal_of([](Sensor& s) { s.rosette = {1, 2}; }),
              HasSubstr("number of elevations = 16"));
  EXPECT_THAT(refusal_of([](Sensor& s) { s.max_range = s.min_range; }), HasSubstr("max_range"));
  EXPECT_THAT(refusal_of([](Sensor& s) { s.range_sigma = -1; }), HasSubstr("range_sigma = -1"));
  EXPECT_THAT(refusal_of([](Sensor& s) { s.height = 101; }), HasSubstr("height = 101"));
}

}  // namespace
}  // namespace flagstone
