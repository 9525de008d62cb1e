// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "library/ground_map/levelled_scan.hpp"

#include <cmath>

namespace flagstone {

LevelledScan::LevelledScan(const LabelVoteConfig& config, CloudView cloud,
                           const Segmentation& result, const Pose& pose,
                           const Levelling& levelling) noexcept
    : scan_{.cloud = cloud, .labels = result.labels(), .heights = result.heights()},
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
  const double sensor_height = pose.position[2] - levelling.offset;
  const auto first_level =
      static_cast<std::int64_t>(std::floor(sensor_height / config.voxel_height));
  first_level_ = static_cast<std::uint32_t>(first_level);
  grid_ = {.rotation = pose.rotation,
           .to_sensor = {pose.position[0] - static_cast<double>(first_.x) * width,
                         pose.position[1] - static_cast<double>(first_.y) * width,
                         sensor_height - static_cast<double>(first_level) * config.voxel_height},
           .slope_x = levelling.slope_x,
           .slope_y = levelling.slope_y,
           .per_metre = 1 / config.voxel,
           .per_metre_up = 1 / config.voxel_height,
           .width = static_cast<std::uint32_t>(side_ * VoxelTile::width)};
  sensor_column_ = std::floor(grid_.to_sensor[0] * grid_.per_metre);
  sensor_row_ = std::floor(grid_.to_sensor[1] * grid_.per_metre);
}

}  // namespace flagstone
