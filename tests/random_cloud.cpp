// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "random_cloud.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <random>

namespace flagstone::tests {
namespace {

/// 0 <= value < 1. Unlike std::uniform_*, std::mt19937 gives the same numbers everywhere.
float unit(std::mt19937& random) { return static_cast<float>(random() >> 8U) / 16777216.0f; }

}  // namespace

std::vector<Point> random_cloud(std::size_t points, std::uint32_t seed) {
  std::mt19937 random(seed);
  const float slope_x = 0.06f * (unit(random) - 0.5f);
  const float slope_y = 0.04f * (unit(random) - 0.5f);
  std::vector<Point> cloud;
  cloud.reserve(points);
  for (std::size_t i = 0; i < points; ++i) {
    const std::size_t beam = i * 64 / points;
    const float turn = static_cast<float>(i * 64 % points) / static_cast<float>(points);
    const float angle = 6.2831853f * turn;
    float range = 3.0f * std::pow(1.055f, static_cast<float>(beam)) * (1 + 0.002f * unit(random));
    float x = range * std::cos(angle);
    float y = range * std::sin(angle);
    float z = -1.73f + slope_x * x + slope_y * y + 0.03f * (unit(random) - 0.5f);
    if (std::abs(y) > 9 && std::abs(y) < 16) z += 4 * unit(random);      // walls
    if (std::fmod(std::abs(x), 11.0f) < 3 && y > 4 && y < 6) z += 1.4f;  // boxes
    if (unit(random) < 0.0005f) z -= 1.5f;                               // reflections
    cloud.push_back({x, y, z});
  }
  return cloud;
}

std::vector<Point> corrupted_cloud(std::size_t points, std::uint32_t seed) {
  std::vector<Point> cloud = random_cloud(points, seed);
  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  constexpr float inf = std::numeric_limits<float>::infinity();
  constexpr float most = std::numeric_limits<float>::max();
  constexpr std::array odd = {nan,   inf,     -inf,    0.0f,  -0.0f,  1e-40f, most,
                              -most, 3e38f,   -3e38f,  1e20f, -1e20f, 2.7f,   80.0f,
                              6.43f, 13.266f, 22.025f, -2.7f, -80.0f, 1e6f};
  std::mt19937 random(seed + 1);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const auto what = random() % 40;
    const float value = odd[random() % odd.size()];
    if (what == 0) cloud[i].x = value;
    if (what == 1) cloud[i].y = value;
    if (what == 2) cloud[i].z = value;
    if (what == 3) cloud[i] = {0, 0, 0};
    if (what == 4) cloud[i] = cloud[random() % cloud.size()];
    if (what == 5) cloud[i] = {5.5f, 5.5f, -1.7f};
    if (what == 6) cloud[i] = {value, value, value};
  }
  return cloud;
}

}  // namespace flagstone::tests
