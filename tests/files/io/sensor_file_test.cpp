// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "files/io/sensor_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "files/io/file_contents.hpp"
#include "files/io/temporary_folder.hpp"

namespace flagstone::io {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

const std::string robot =
    "beams = 4\nelevation_top = 3.0\nelevation_bottom = -15.0\nheight = 0.6\n";

Sensor parsed(const std::string& text) {
  Sensor sensor;
  const Status status = parse_sensor(text, "robot.toml", sensor);
  EXPECT_TRUE(status.ok()) << status.message();
  return sensor;
}

std::string refusal_of(const std::string& text) {
  Sensor sensor;
  return parse_sensor(text, "robot.toml", sensor).message();
}

TEST(SensorFile, MatchesTheLibraryForEveryKnownSensor) {
  for (const Sensor& known : Sensor::known()) {
    Sensor read;
    const Status status =
        read_sensor(std::filesystem::path(FLAGSTONE_SENSORS) / (known.name + ".toml"), read);

    ASSERT_TRUE(status.ok()) << status.message();
    EXPECT_EQ(read.name, known.name);
    EXPECT_EQ(read.title, known.title);
    EXPECT_EQ(read.elevations, known.elevations) << known.name;
    EXPECT_EQ(read.firings, known.firings) << known.name;
    EXPECT_EQ(read.azimuth_begin, known.azimuth_begin) << known.name;
    EXPECT_EQ(read.azimuth_end, known.azimuth_end) << known.name;
    EXPECT_EQ(read.rosette, known.rosette) << known.name;
    EXPECT_EQ(read.min_range, known.min_range) << known.name;
    EXPECT_EQ(read.max_range, known.max_range) << known.name;
    EXPECT_EQ(read.range_sigma, known.range_sigma) << known.name;
    EXPECT_EQ(read.height, known.height) << known.name;
  }
}

TEST(SensorFile, ExistsForEachKnownSensorAndNoOther) {
  std::size_t files = 0;
  for ([[maybe_unused]] const auto& file : std::filesystem::directory_iterator(FLAGSTONE_SENSORS)) {
    ++files;
  }
  EXPECT_EQ(files, Sensor::known().size());
}

TEST(SensorFile, MayHaveOnlyFourLines) {
  const Sensor sensor = parsed(robot);

  EXPECT_THAT(sensor.elevations, ElementsAre(3.0, -3.0, -9.0, -15.0));
  EXPECT_EQ(sensor.height, 0.6);
  EXPECT_EQ(sensor.name, "robot");
  EXPECT_EQ(sensor.title, "robot");
  EXPECT_TRUE(sensor.sees_all_around());
  EXPECT_EQ(sensor.firings, 1800);
  EXPECT_EQ(sensor.min_range, 0.5);
  EXPECT_EQ(sensor.max_range, 100);
  EXPECT_EQ(sensor.range_sigma, 0.02);
}

TEST(SensorFile, FiringsDependOnTheWidthOfTheViewUnlessGiven) {
  EXPECT_EQ(parsed(robot + "azimuth_begin = -45\nazimuth_end = 45.0\n").firings, 450);
  EXPECT_EQ(parsed(robot + "firings = 99\n").firings, 99);
}

TEST(SensorFile, RosetteRequiresTheEdgesOfItsView) {
  const Sensor sensor = parsed(
      "elevation_top = 30\nelevation_bottom = -30\nrosette = [60, -40]\nheight = 1\n"
      "azimuth_begin = -30\nazimuth_end = 30\n");

  EXPECT_TRUE(sensor.draws_rosette());
  EXPECT_THAT(sensor.elevations, ElementsAre(30.0, -30.0));
  EXPECT_EQ(sensor.firings, 24000);
}

TEST(SensorFile, AcceptsASingleBeam) {
  EXPECT_THAT(
      parsed("beams = 1\nelevation_top = -5\nelevation_bottom = -5\nheight = 1\n").elevations,
      ElementsAre(-5.0));
  EXPECT_THAT(parsed("elevations = [-5]\nheight = 1\n").elevations, ElementsAre(-5.0));
}

TEST(SensorFile, ErrorsReportPositionKeyAndExpectedValue) {
  EXPECT_THAT(refusal_of(robot + "beems = 3\n"),
              AllOf(StartsWith("robot.toml: line 5, column 9: 'beems' is not a key of a sensor"),
                    HasSubstr("elevations"), HasSubstr("did you mean 'beams'?")));
  EXPECT_THAT(refusal_of(robot + "max_range = \"far\"\n"),
              StartsWith("robot.toml: line 5, column 13: max_range must be a number"));
  EXPECT_THAT(refusal_of(robot + "max_range = -1\n"),
              AllOf(StartsWith("robot.toml: line 5, column 13: "), HasSubstr("max_range = -1"),
                    HasSubstr("(expected above 0.5, up to 1000 m)")));
  EXPECT_THAT(refusal_of(robot + "firings = 1.5\n"), HasSubstr("firings must be an integer"));
  EXPECT_THAT(refusal_of(robot + "range_sigma = nan\n"), HasSubstr("range_sigma = nan"));
  EXPECT_THAT(refusal_of(robot + "elevations = [1, 0]\n"), HasSubstr("cannot be combined"));
  EXPECT_THAT(refusal_of("elevations = [-1, 0]\nheight = 1\n"),
              AllOf(StartsWith("robot.toml: line 1"), HasSubstr("list the highest first")));
  EXPECT_THAT(refusal_of("elevations = [95, 0]\nheight = 1\n"),
              HasSubstr("elevations[0] = 95 is out of range (expected -90 to 90 degrees"));
  EXPECT_THAT(refusal_of("elevations = 3\nheight = 1\n"), HasSubstr("must be an array of numbers"));
  EXPECT_THAT(refusal_of("elevations = [\"a\"]\nheight = 1\n"), HasSubstr("must be a number"));
  EXPECT_THAT(refusal_of("name = \"\"\n" + robot), HasSubstr("name must be a string"));
  EXPECT_THAT(refusal_of("beams = \n"), StartsWith("robot.toml: line 1"));
}

TEST(SensorFile, ReportsMissingKeys) {
  EXPECT_THAT(refusal_of("height = 1\n"), HasSubstr("elevation_top is missing"));
  EXPECT_THAT(refusal_of("elevation_top = 1\nheight = 1\n"),
              HasSubstr("elevation_bottom is missing"));
  EXPECT_THAT(refusal_of("elevation_top = 1\nelevation_bottom = 0\nheight = 1\n"),
              HasSubstr("beams is missing or out of range (expected 1 to 1024)"));
  EXPECT_THAT(refusal_of("elevations = [0]\n"), HasSubstr("height is missing"));
  EXPECT_THAT(refusal_of("beams = 4\nelevation_top = -5\nelevation_bottom = 5\nheight = 1\n"),
              HasSubstr("elevation_top = -5 (expected a value above elevation_bottom"));
}

TEST(SensorFile, KeepsTheSensorOnFailure) {
  Sensor sensor = parsed(robot);
  EXPECT_FALSE(parse_sensor(robot + "height = 2\n", "twice.toml", sensor).ok());
  EXPECT_FALSE(read_sensor("/nowhere/robot.toml", sensor).ok());
  EXPECT_EQ(sensor.height, 0.6);
}

TEST(FindSensor, AcceptsNamesAndFiles) {
  const TemporaryFolder folder;
  put_file(folder / "robot.toml", robot);
  Sensor sensor;

  EXPECT_TRUE(find_sensor("os0-128", sensor).ok());
  EXPECT_EQ(sensor.name, "os0-128");
  EXPECT_TRUE(find_sensor((folder / "robot.toml").string(), sensor).ok());
  EXPECT_EQ(sensor.name, "robot");
  EXPECT_EQ(find_sensor((folder / "no.toml").string(), sensor).code(), StatusCode::not_found);
  EXPECT_THAT(find_sensor("os9", sensor).message(),
              AllOf(HasSubstr("'os9'"), HasSubstr("os0-128"), HasSubstr(".toml file"),
                    Not(HasSubstr("\n"))));
}

}  // namespace
}  // namespace flagstone::io
