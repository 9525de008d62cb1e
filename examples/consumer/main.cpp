// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT

// Flat ground around the sensor with a post on it: prints the number of ground points.

#include <cmath>
#include <cstddef>
#include <cstdio>
#include <flagstone/flagstone.hpp>
#include <vector>

int main() {
  std::vector<float> points;  // x, y, z, x, y, z, ...
  for (int ring = 0; ring < 144; ++ring) {
    const float range = 4 + 0.25f * static_cast<float>(ring);
    for (int step = 0; step < 628; ++step) {
      const float angle = 0.01f * static_cast<float>(step);
      points.insert(points.end(), {range * std::cos(angle), range * std::sin(angle), -1.73f});
    }
  }
  for (int step = -20; step <= 20; ++step) {
    points.insert(points.end(), {10.0f, 0.0f, 0.05f * static_cast<float>(step)});
  }

  flagstone::Surface segmenter({.sensor_height = 1.73f});
  flagstone::Segmentation result;
  const flagstone::CloudView cloud(points.data(), points.size() / 3);
  if (!segmenter.segment(cloud, result).ok()) return 1;

  std::size_t ground = 0;
  for (const flagstone::Label label : result.labels()) {
    if (label == flagstone::Label::ground) ++ground;
  }
  std::printf("flagstone %s: %zu of %zu points are ground\n", FLAGSTONE_VERSION, ground,
              cloud.size());
  return ground > 90000 && ground < cloud.size() ? 0 : 1;
}
