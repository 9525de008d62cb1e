// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT

// Reuse the same two objects for every scan, and print the status of each patch of ground.

#include <cmath>
#include <cstdio>
#include <flagstone/flagstone.hpp>
#include <vector>

namespace {

/// Ground that rises ahead of the sensor with `slope`, m/m.
std::vector<float> make_scan(float slope) {
  std::vector<float> xyz;
  for (int ring = 0; ring < 144; ++ring) {
    const float range = 4 + 0.25f * static_cast<float>(ring);
    for (int step = 0; step < 628; ++step) {
      const float angle = 0.01f * static_cast<float>(step);
      const float x = range * std::cos(angle);
      xyz.insert(xyz.end(), {x, range * std::sin(angle), slope * x - 1.73f});
    }
  }
  return xyz;
}

}  // namespace

int main() {
  // Both objects keep their memory, so nothing is allocated after the first scans. They keep
  // nothing else: the labels of a scan never depend on previous scans. Use one pair per thread.
  flagstone::Patchwork patchwork(flagstone::PatchworkConfig::preset("default"));
  flagstone::Segmentation scan;

  for (const float slope : {0.0f, 0.05f, 0.1f}) {
    const std::vector<float> xyz = make_scan(slope);
    const std::size_t count = xyz.size() / 3;
    if (!patchwork.segment(flagstone::CloudView(xyz.data(), count), scan).ok()) return 1;
    std::printf("slope %.2f, ground: %zu of %zu points, %zu patches\n", slope,
                scan.count(flagstone::Label::ground), count, scan.patches().size());
  }

  // Patches of the last scan: position, number of points, plane normal . p + d = 0, and status.
  for (const flagstone::Patch& patch : scan.patches().first(5)) {
    std::printf("zone %d ring %d sector %2d: %3u points, normal (%.3f %.3f %.3f), d %.2f, %s\n",
                patch.zone, patch.ring, patch.sector, patch.point_count, patch.normal[0],
                patch.normal[1], patch.normal[2], patch.d, to_string(patch.verdict));
  }
}
