// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "library/ground_map/ground_scan.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

namespace flagstone {

double level_ground(double /*x*/, double /*y*/) { return 0; }

Pose upright_pose(const TrueGround& ground, double x, double y, double yaw, double above) {
  const double c = std::cos(yaw);
  const double s = std::sin(yaw);
  return {.rotation = {c, -s, 0, s, c, 0, 0, 0, 1}, .position = {x, y, ground(x, y) + above}};
}

GroundScan::GroundScan(const TrueGround& ground, const Pose& pose, double reach) {
  const auto& r = pose.rotation;
  const auto& p = pose.position;
  const auto local_ground = [&](double x, double y) {
    return ground(p[0] + r[0] * x + r[1] * y, p[1] + r[3] * x + r[4] * y) - p[2];
  };
  for (double y = -reach; y <= reach; y += 0.25) {
    for (double x = -reach; x <= reach; x += 0.25) {
      if (std::hypot(x, y) > reach) continue;
      for (const double value : {x, y, local_ground(x, y)})
        xyz.push_back(static_cast<float>(value));
    }
  }
  std::ranges::fill(result.start(xyz.size() / 3), Label::ground);
  std::ranges::fill(result.start_heights(), 0.0F);
  result.finish();
  std::vector<GroundSurface::Grid>& grids = result.mutable_surface().start();
  grids.resize(1);
  GroundSurface::Grid& grid = grids[0];
  grid.cell = 0.25F;
  grid.width = 320;
  grid.heights.clear();
  for (std::size_t row = 0; row < grid.width; ++row) {
    for (std::size_t column = 0; column < grid.width; ++column) {
      const auto centre = [&](std::size_t index) {
        return (static_cast<double>(index) + 0.5 - static_cast<double>(grid.width) / 2) * 0.25;
      };
      grid.heights.push_back(static_cast<float>(local_ground(centre(column), centre(row))));
    }
  }
  grid.confidences.assign(grid.heights.size(), 1);
}

}  // namespace flagstone
