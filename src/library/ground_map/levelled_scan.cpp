// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "library/ground_map/levelled_scan.hpp"

#include <cmath>

#include "library/ground_map/voxel_tiles.hpp"

namespace flagstone {

LevelledScan::LevelledScan(const LabelVoteConfig& config, CloudView cloud,
                           const Segmentation& result, const Pose& pose,
                           const Levelling& levelling) noexcept
    : cloud_(cloud),
      result_(result),
      filter_{.nonground = true,
              .min_height = config.min_height,
              .max_height = config.max_height,
              .reach = static_cast<float>(config.max_range)},
      voxel_(config.voxel) {
  // On a slope, points are farther from the sensor in the world frame than in its own.
  constexpr double margin = 1.25;
  const double width = static_cast<double>(VoxelTile::width) * config.voxel;
  const double reach = margin * config.max_range;
  const auto first = [&](double position) {
    return static_cast<std::int64_t>(std::floor((position - reach) / width));
  };
  side_ = static_cast<std::size_t>(std::ceil(2 * reach / width)) + 1;
  first_ = {.x = first(pose.position[0]), .y = first(pose.position[1])};
  grid_ = {.rotation = pose.rotation,
           .to_sensor = {pose.position[0] - static_cast<double>(first_.x) * width,
                         pose.position[1] - static_cast<double>(first_.y) * width,
                         pose.position[2] - levelling.offset},
           .slope_x = levelling.slope_x,
           .slope_y = levelling.slope_y,
           .per_metre = 1 / config.voxel,
           .per_metre_up = 1 / config.voxel_height,
           .width = static_cast<std::uint32_t>(side_ * VoxelTile::width)};
  sensor_column_ = std::floor(grid_.to_sensor[0] * grid_.per_metre);
  sensor_row_ = std::floor(grid_.to_sensor[1] * grid_.per_metre);
}

double LevelledScan::squared_range(std::uint32_t tile, std::uint32_t key) const noexcept {
  const auto index = [](std::size_t place, std::uint32_t in_tile) {
    return static_cast<double>(place * VoxelTile::width + in_tile);
  };
  const double x = (index(tile % side_, VoxelKey::x(key)) - sensor_column_ + 0.5) * voxel_;
  const double y = (index(tile / side_, VoxelKey::y(key)) - sensor_row_ + 0.5) * voxel_;
  return x * x + y * y;
}

void LevelledScan::read(std::size_t begin, PointVoxels& voxels) const noexcept {
  const GridPoints& points = voxels.points;
  find_in_grid(cloud_, result_, filter_, grid_, begin, voxels.points);
  const auto side = static_cast<std::uint32_t>(side_);
  constexpr unsigned bits = VoxelKey::horizontal_bits;
  constexpr std::uint32_t mask = (1U << bits) - 1;
  // Also for points outside, whose values do not matter. GridPoints::base_level is a multiple of
  // the period of keys.
  for (std::size_t k = 0; k < points.count; ++k) {
    const auto column = static_cast<std::uint32_t>(points.column[k]);
    const auto row = static_cast<std::uint32_t>(points.row[k]);
    voxels.tile[k] = (row >> bits) * side + (column >> bits);
    voxels.key[k] =
        VoxelKey::of(column & mask, row & mask, static_cast<std::uint32_t>(points.level[k]));
  }
}

}  // namespace flagstone
