// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT

// A project that uses flagstone: segments flat ground with a post on it and checks every label.

#include <cmath>
#include <cstdio>
#include <flagstone/flagstone.hpp>
#include <vector>

int main() {
  std::vector<float> xyz;
  for (int ring = 0; ring < 144; ++ring) {
    const float range = 4 + 0.25f * static_cast<float>(ring);
    for (int step = 0; step < 628; ++step) {
      const float angle = 0.01f * static_cast<float>(step);
      xyz.insert(xyz.end(), {range * std::cos(angle), range * std::sin(angle), -1.73f});
    }
  }
  const std::size_t ground_points = xyz.size() / 3;
  for (int step = -20; step <= 20; ++step) {
    xyz.insert(xyz.end(), {10.0f, 0.0f, 0.05f * static_cast<float>(step)});
  }
  const std::size_t points = xyz.size() / 3;

  flagstone::Patchwork patchwork({.sensor_height = 1.73f});
  flagstone::Segmentation scan;
  if (!patchwork.segment(flagstone::CloudView(xyz.data(), points), scan).ok()) return 1;

  std::size_t wrong = 0;
  for (std::size_t i = 0; i < points; ++i) {
    const auto truth = i < ground_points ? flagstone::Label::ground : flagstone::Label::nonground;
    if (scan.labels()[i] != truth) ++wrong;
  }
  std::printf("flagstone %s: %zu of %zu labels are wrong\n", FLAGSTONE_VERSION, wrong, points);
  return wrong == 0 && scan.labels().size() == points ? 0 : 1;
}
