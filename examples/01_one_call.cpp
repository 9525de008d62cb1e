// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT

// One call: from an array of floats to one label per point.

#include <cmath>
#include <cstdio>
#include <flagstone/flagstone.hpp>
#include <vector>

namespace {

/// Flat ground 1.73 m below the sensor, as circles of points, and a wall 10 m ahead. In metres; x
/// is forward, y left, z up.
std::vector<float> make_scan() {
  std::vector<float> xyz;
  for (int ring = 0; ring < 144; ++ring) {
    const float range = 4 + 0.25f * static_cast<float>(ring);
    for (int step = 0; step < 628; ++step) {
      const float angle = 0.01f * static_cast<float>(step);
      xyz.insert(xyz.end(), {range * std::cos(angle), range * std::sin(angle), -1.73f});
    }
  }
  for (int column = -60; column <= 60; ++column) {
    for (int row = -32; row <= 20; ++row) {
      const float y = 0.05f * static_cast<float>(column);
      const float z = 0.05f * static_cast<float>(row);
      xyz.insert(xyz.end(), {10.0f, y, z});
    }
  }
  return xyz;
}

}  // namespace

int main() {
  const std::vector<float> xyz = make_scan();
  const std::size_t count = xyz.size() / 3;

  flagstone::SurfaceConfig config;
  config.sensor_height = 1.73f;  // height of the sensor above the ground, metres
  flagstone::Surface segmenter(config);
  flagstone::Segmentation scan;
  const flagstone::Status status = segmenter.segment(flagstone::CloudView(xyz.data(), count), scan);
  if (!status.ok()) {
    std::fprintf(stderr, "%s\n", status.message().c_str());
    return 1;
  }

  // scan.labels()[i] is the label of point i. The last point is a top corner of the wall.
  std::printf("ground: %zu of %zu points\n", scan.count(flagstone::Label::ground), count);
  std::printf("the first point is %s, the last one is %s\n", to_string(scan.labels().front()),
              to_string(scan.labels().back()));
}
