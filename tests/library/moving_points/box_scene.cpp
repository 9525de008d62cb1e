// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "library/moving_points/box_scene.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace flagstone {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// The distance along a ray to a box, or infinity.
double distance_to(const Box& box, const std::array<double, 3>& from,
                   const std::array<double, 3>& direction) {
  const std::array<double, 3> low{box.x - box.length / 2, box.y - box.width / 2, 0};
  const std::array<double, 3> high{box.x + box.length / 2, box.y + box.width / 2, box.height};
  double enter = 0;
  double leave = infinity;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double a = (low[axis] - from[axis]) / direction[axis];
    const double b = (high[axis] - from[axis]) / direction[axis];
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  }
  return enter < leave ? enter : infinity;
}

}  // namespace

Pose sensor_at(double x, double y) { return {.position = {x, y, 1.8}}; }

BoxScan::BoxScan(const std::vector<Box>& boxes, const Pose& pose) {
  constexpr int columns = 1800;
  constexpr double max_range = 80;
  constexpr double degree = std::numbers::pi / 180;
  std::vector<float> heights;
  for (int beam = 0; beam < 32; ++beam) {
    const double elevation = (-24.3 + beam) * degree;
    for (int column = 0; column < columns; ++column) {
      const double azimuth = (column + 0.5) * 360 / columns * degree;
      const std::array<double, 3> direction{std::cos(elevation) * std::cos(azimuth),
                                            std::cos(elevation) * std::sin(azimuth),
                                            std::sin(elevation)};
      double range = direction[2] < 0 ? -pose.position[2] / direction[2] : infinity;
      int box = no_box;
      for (std::size_t k = 0; k < boxes.size(); ++k) {
        const double distance = distance_to(boxes[k], pose.position, direction);
        if (distance >= range) continue;
        range = distance;
        box = static_cast<int>(k);
      }
      if (range > max_range) continue;
      for (const double part : direction) xyz.push_back(static_cast<float>(range * part));
      box_of_points.push_back(box);
      heights.push_back(static_cast<float>(pose.position[2] + range * direction[2]));
    }
  }
  const auto labels = result.start(box_of_points.size());
  std::ranges::transform(box_of_points, labels.begin(),
                         [](int box) { return box == no_box ? Label::ground : Label::nonground; });
  std::ranges::copy(heights, result.start_heights().begin());
  result.finish();
}

}  // namespace flagstone
