// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "files/ros/field_convention.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace flagstone::ros {
namespace {

using enum PointFieldType;

struct Driver {
  std::string name;
  std::vector<PointField> fields;
  Convention convention;
  std::string time;
  double seconds_per_unit;
  TimeReference reference;
  std::string ring;
  std::string intensity;
};

void PrintTo(const Driver& driver, std::ostream* out) { *out << driver.name; }

/// Fields as the drivers publish them; docs/reference/point-cloud2.md lists the sources.
std::vector<Driver> drivers() {
  using enum TimeReference;
  return {
      {"velodyne",
       {{"x", 0, float32, 1},
        {"y", 4, float32, 1},
        {"z", 8, float32, 1},
        {"intensity", 12, float32, 1},
        {"ring", 16, uint16, 1},
        {"time", 18, float32, 1}},
       Convention::velodyne,
       "time",
       1,
       header_stamp,
       "ring",
       "intensity"},
      {"ouster_original",
       {{"x", 0, float32, 1},
        {"y", 4, float32, 1},
        {"z", 8, float32, 1},
        {"intensity", 16, float32, 1},
        {"t", 20, uint32, 1},
        {"reflectivity", 24, uint16, 1},
        {"ring", 26, uint16, 1},
        {"ambient", 28, uint16, 1},
        {"range", 32, uint32, 1}},
       Convention::ouster,
       "t",
       1e-9,
       header_stamp,
       "ring",
       "intensity"},
      {"ouster_native",
       {{"x", 0, float32, 1},
        {"y", 4, float32, 1},
        {"z", 8, float32, 1},
        {"t", 16, uint32, 1},
        {"ring", 20, uint16, 1},
        {"range", 24, uint32, 1},
        {"signal", 28, uint16, 1},
        {"reflectivity", 30, uint8, 1},
        {"near_ir", 32, uint16, 1}},
       Convention::ouster,
       "t",
       1e-9,
       header_stamp,
       "ring",
       "signal"},
      {"hesai",
       {{"x", 0, float32, 1},
        {"y", 4, float32, 1},
        {"z", 8, float32, 1},
        {"intensity", 12, float32, 1},
        {"ring", 16, uint16, 1},
        {"timestamp", 18, float64, 1}},
       Convention::hesai,
       "timestamp",
       1,
       clock,
       "ring",
       "intensity"},
      {"livox_driver2",
       {{"x", 0, float32, 1},
        {"y", 4, float32, 1},
        {"z", 8, float32, 1},
        {"intensity", 12, float32, 1},
        {"tag", 16, uint8, 1},
        {"line", 17, uint8, 1},
        {"timestamp", 18, float64, 1}},
       Convention::livox,
       "timestamp",
       1e-9,
       clock,
       "line",
       "intensity"},
      {"livox_driver1",
       {{"x", 0, float32, 1},
        {"y", 4, float32, 1},
        {"z", 8, float32, 1},
        {"intensity", 12, float32, 1},
        {"tag", 16, uint8, 1},
        {"line", 17, uint8, 1}},
       Convention::livox,
       "",
       0,
       clock,
       "line",
       "intensity"},
      {"livox_custom",
       {{"offset_time", 0, uint32, 1},
        {"x", 4, float32, 1},
        {"y", 8, float32, 1},
        {"z", 12, float32, 1},
        {"reflectivity", 16, uint8, 1},
        {"tag", 17, uint8, 1},
        {"line", 18, uint8, 1}},
       Convention::livox,
       "offset_time",
       1e-9,
       header_stamp,
       "line",
       "reflectivity"},
      {"autoware",
       {{"x", 0, float32, 1},
        {"y", 4, float32, 1},
        {"z", 8, float32, 1},
        {"intensity", 12, uint8, 1},
        {"return_type", 13, uint8, 1},
        {"channel", 14, uint16, 1},
        {"azimuth", 16, float32, 1},
        {"elevation", 20, float32, 1},
        {"distance", 24, float32, 1},
        {"time_stamp", 28, uint32, 1}},
       Convention::autoware,
       "time_stamp",
       1e-9,
       header_stamp,
       "channel",
       "intensity"},
      {"xyzir",
       {{"x", 0, float32, 1},
        {"y", 4, float32, 1},
        {"z", 8, float32, 1},
        {"intensity", 12, float32, 1},
        {"ring", 16, uint16, 1}},
       Convention::xyz,
       "",
       0,
       header_stamp,
       "ring",
       "intensity"},
      {"xyz",
       {{"x", 0, float64, 1}, {"y", 8, float64, 1}, {"z", 16, float64, 1}},
       Convention::xyz,
       "",
       0,
       header_stamp,
       "",
       ""},
      {"image", {{"rgb", 0, float32, 1}}, Convention::none, "", 0, header_stamp, "", ""},
      {"nothing", {}, Convention::none, "", 0, header_stamp, "", ""},
  };
}

std::string name_of(const PointField* field) {
  return field == nullptr ? "" : std::string(field->name);
}

class FieldConventionOf : public ::testing::TestWithParam<Driver> {};
INSTANTIATE_TEST_SUITE_P(Drivers, FieldConventionOf, ::testing::ValuesIn(drivers()),
                         [](const auto& driver) { return driver.param.name; });

TEST_P(FieldConventionOf, IsRecognizedInAnyOrderOfFields) {
  Driver driver = GetParam();
  for (std::size_t turn = 0; turn <= driver.fields.size(); ++turn) {
    const FieldConvention found = recognize(driver.fields);
    EXPECT_STREQ(to_string(found.convention), to_string(driver.convention));
    EXPECT_EQ(name_of(found.time), driver.time);
    EXPECT_EQ(found.seconds_per_unit, driver.seconds_per_unit);
    EXPECT_EQ(found.time_reference, driver.reference);
    EXPECT_EQ(name_of(found.ring), driver.ring);
    EXPECT_EQ(name_of(found.intensity), driver.intensity);
    if (!driver.fields.empty()) std::ranges::rotate(driver.fields, driver.fields.begin() + 1);
  }
}

TEST(FieldConvention, DependsOnTypes) {
  std::vector<PointField> fields = drivers()[0].fields;
  fields[5].type = float64;
  EXPECT_EQ(recognize(fields).convention, Convention::xyz);
  fields[5].type = float32;
  fields[5].count = 2;
  EXPECT_EQ(recognize(fields).convention, Convention::xyz);
}

TEST(FieldConvention, HasAName) {
  EXPECT_STREQ(to_string(Convention::none), "none");
  EXPECT_STREQ(to_string(Convention::livox), "livox");
}

}  // namespace
}  // namespace flagstone::ros
