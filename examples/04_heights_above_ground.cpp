// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT

// The height of each point above the ground, and the ground itself at any position.

#include <cmath>
#include <cstdio>
#include <flagstone/flagstone.hpp>
#include <vector>

namespace {

/// Ground that rises ahead of the sensor by 5 cm per metre, and a post 1.2 m high at x = 12, y = 3.
std::vector<float> make_scan() {
  std::vector<float> xyz;
  for (int ring = 0; ring < 144; ++ring) {
    const float range = 4 + 0.25f * static_cast<float>(ring);
    for (int step = 0; step < 628; ++step) {
      const float angle = 0.01f * static_cast<float>(step);
      const float x = range * std::cos(angle);
      xyz.insert(xyz.end(), {x, range * std::sin(angle), 0.05f * x - 1.73f});
    }
  }
  for (int step = 0; step <= 24; ++step) {
    const float base = 0.05f * 12 - 1.73f;
    xyz.insert(xyz.end(), {12.0f, 3.0f, base + 0.05f * static_cast<float>(step)});
  }
  return xyz;
}

}  // namespace

int main() {
  const std::vector<float> xyz = make_scan();
  const std::size_t count = xyz.size() / 3;

  flagstone::Surface segmenter({.sensor_height = 1.73f});
  flagstone::Segmentation scan;
  if (!segmenter.segment(flagstone::CloudView(xyz.data(), count), scan).ok()) return 1;
  std::printf("ground: %zu of %zu points\n", scan.count(flagstone::Label::ground), count);

  // heights()[i] is the height of point i above the ground, in metres; NaN if the ground is
  // unknown. The last point is the top of the post.
  std::printf("the post is %.2f m high\n", static_cast<double>(scan.heights().back()));

  // You can query the ground at any position, with or without points there.
  const flagstone::GroundSurface& surface = scan.surface();
  for (const float x : {10.0f, 20.0f, 30.0f}) {
    const flagstone::GroundSample ground = surface.at(x, 0);
    std::printf("x %.0f m: ground at z %.2f m, slope %.3f rad, confidence %.2f, cells of %.2f m\n",
                static_cast<double>(x), static_cast<double>(ground.height),
                static_cast<double>(ground.slope), static_cast<double>(ground.confidence),
                static_cast<double>(surface.resolution(x, 0)));
  }

  // height() is faster than at(). Below the sensor nothing was measured: the surface is
  // interpolated from the ground around it.
  std::printf("below the sensor: z %.2f m\n", static_cast<double>(surface.height(0, 0)));

  // Far from all points the ground is unknown, and its height is NaN.
  std::printf("%s 90 m to the left\n", std::isnan(surface.height(0, 90)) ? "unknown" : "known");
}
