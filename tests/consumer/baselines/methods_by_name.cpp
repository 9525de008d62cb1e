// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT

// A project that compares methods: runs every method by name on flat ground and checks the labels.

#include <cmath>
#include <cstdio>
#include <flagstone/baselines.hpp>
#include <flagstone/flagstone.hpp>
#include <vector>

int main() {
  std::vector<float> xyz;
  for (int beam = 0; beam < 60; ++beam) {
    const float range = 1.73f / std::tan(0.43f - 0.0065f * static_cast<float>(beam));
    for (int step = 0; step < 1000; ++step) {
      const float angle = 0.00628f * static_cast<float>(step);
      xyz.insert(xyz.end(), {range * std::cos(angle), range * std::sin(angle), -1.73f});
    }
  }
  const flagstone::CloudView cloud(xyz.data(), xyz.size() / 3);

  flagstone::register_baselines();
  flagstone::Segmentation scan;
  for (const std::string_view name : flagstone::method_names()) {
    const auto segmenter = flagstone::make_segmenter(name);
    if (!segmenter->segment(cloud, scan).ok()) return 1;
    const std::size_t ground = scan.count(flagstone::Label::ground);
    std::printf("%-10s %zu of %zu points are ground\n", name.data(), ground, cloud.size());
    if (ground * 10 < cloud.size() * 8) return 1;
  }
  return 0;
}
