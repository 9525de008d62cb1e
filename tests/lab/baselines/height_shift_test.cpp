// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
// The origin of a cloud can be outside the sensor: in a map frame or a vehicle frame it is at or
// below the ground. The labels must be the same as with the origin in the sensor.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <memory>
#include <ostream>
#include <string>
#include <vector>

#include "edge_scan.hpp"
#include "flagstone/baselines.hpp"
#include "library/methods/method.hpp"
#include "random_cloud.hpp"

namespace flagstone {
namespace {

struct Case {
  std::string name;
  std::string method;
  MethodConfig config;

  friend void PrintTo(const Case& method, std::ostream* out) { *out << method.name; }
};

std::vector<Case> cases() {
  register_baselines();
  std::vector<Case> all;
  for (const std::string_view method : method_names()) {
    all.push_back({std::string(method), std::string(method), default_config(method)});
  }
  for (const std::string_view preset : PatchworkConfig::preset_names()) {
    all.push_back(
        {"patchwork_" + std::string(preset), "patchwork", PatchworkConfig::preset(preset)});
  }
  // gpf and cascaded reject heights that are not above 0.
  std::erase_if(all,
                [](const Case& each) { return each.name == "gpf" || each.name == "cascaded"; });
  for (Case& each : all) {
    std::ranges::replace_if(each.name, [](char c) { return c == '+'; }, '_');
  }
  return all;
}

/// A ditch to the left, a drop to the right, ghost points below the ground, walls and boxes.
/// Heights are multiples of 1/1024 m, so that they can be shifted without rounding.
std::vector<Point> scene() {
  std::vector<Point> cloud = tests::edge_scan(tests::ditch_of(0.6f));
  tests::add_ghosts(cloud, 200);
  for (Point p : tests::edge_scan(tests::step_of(-1))) {
    p.y = -p.y;
    cloud.push_back(p);
  }
  std::ranges::copy(tests::random_cloud(20000, 3), std::back_inserter(cloud));
  for (Point& p : cloud) p.z = std::round(p.z * 1024) / 1024;
  return cloud;
}

/// Labels of a cloud raised by `rise`, metres, with the sensor height adjusted accordingly.
std::vector<Label> labels_of(const Case& method, std::vector<Point> cloud, float rise) {
  MethodConfig config = method.config;
  set_sensor_height(1.73f - rise, config);
  for (Point& p : cloud) p.z += rise;
  Segmentation result;
  EXPECT_TRUE(make_segmenter(method.method, config)->segment(tests::view_of(cloud), result).ok());
  return {result.labels().begin(), result.labels().end()};
}

class HeightShift : public testing::TestWithParam<Case> {};

INSTANTIATE_TEST_SUITE_P(All, HeightShift, testing::ValuesIn(cases()),
                         [](const auto& each) { return each.param.name; });

TEST_P(HeightShift, OfPointsAndSensorHeightTogetherChangesHardlyAnyLabel) {
  const std::vector<Point> cloud = scene();
  const std::vector<Label> labels = labels_of(GetParam(), cloud, 0);

  for (const float rise : {1.75f, 2.75f, 12.75f}) {  // the ground 2 cm to 11 m above the origin
    const std::vector<Label> shifted = labels_of(GetParam(), cloud, rise);

    // Points within rounding of a threshold may differ. The samples of `surface` depend on the
    // heights of points, so that it does not depend on a wrong sensor height: another origin
    // selects other samples.
    const std::size_t most = cloud.size() / (GetParam().method == "surface" ? 200 : 5000);
    std::size_t different = 0;
    for (std::size_t i = 0; i < cloud.size(); ++i) different += labels[i] != shifted[i];
    EXPECT_LE(different, most) << "raised by " << rise << " m";
  }
}

}  // namespace
}  // namespace flagstone
