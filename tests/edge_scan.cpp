// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "edge_scan.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <random>

namespace flagstone::tests {
namespace {

constexpr float level = -1.73f;
constexpr float edge = 5;

}  // namespace

std::vector<Point> edge_scan(const GroundHeight& ground) {
  constexpr float degree = std::numbers::pi_v<float> / 180;
  constexpr float stride = 0.02f;  // along the ground, metres
  std::vector<Point> scan;
  for (float down = 3; down <= 25; down += 0.5f) {
    const float fall = std::tan(down * degree);
    for (float azimuth = 20; azimuth <= 160; azimuth += 0.4f) {
      const float to_x = std::cos(azimuth * degree);
      const float to_y = std::sin(azimuth * degree);
      for (float range = 3; range < 25; range += stride) {
        const float x = range * to_x;
        const float y = range * to_y;
        if (-range * fall > ground(x, y)) continue;
        scan.push_back({x, y, ground(x, y)});
        break;
      }
    }
  }
  return scan;
}

GroundHeight step_of(float rise) {
  return [=](float, float y) { return level + rise * std::clamp((y - edge) / 0.05f, 0.0f, 1.0f); };
}

GroundHeight ditch_of(float depth) {
  return [=](float, float y) {
    const float down = std::clamp(y - edge, 0.0f, 1.0f);
    const float up_again = std::clamp(y - edge - 3, 0.0f, 1.0f);
    return level - depth * (down - up_again);
  };
}

void add_ghosts(std::vector<Point>& scan, std::size_t count) {
  std::vector<Point> near;
  std::ranges::copy_if(scan, std::back_inserter(near),
                       [](const Point& p) { return std::hypot(p.x, p.y) < 15; });
  std::mt19937 random(1);
  for (std::size_t k = 0; k < count; ++k) {
    Point ghost = near[random() % near.size()];
    ghost.z -= 0.4f + 2.0f * static_cast<float>(random() >> 8U) / 16777216.0f;
    scan.push_back(ghost);
  }
}

double share_of(Label label, const std::vector<Point>& cloud, const std::vector<Label>& labels,
                const std::function<bool(const Point&)>& belongs) {
  std::size_t chosen = 0;
  std::size_t labelled = 0;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (!belongs(cloud[i])) continue;
    ++chosen;
    labelled += static_cast<std::size_t>(labels[i] == label);
  }
  EXPECT_GT(chosen, 100U);
  return static_cast<double>(labelled) / static_cast<double>(chosen);
}

}  // namespace flagstone::tests
