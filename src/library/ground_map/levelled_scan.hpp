// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

#include "flagstone/cloud_view.hpp"
#include "flagstone/ground_map.hpp"
#include "flagstone/label_vote.hpp"
#include "flagstone/segmentation.hpp"
#include "library/ground_map/grid_points.hpp"
#include "library/ground_map/scan_voxels.hpp"
#include "library/ground_map/voxel_tiles.hpp"

namespace flagstone {

/// Where the votes on a voxel are.
struct VotePlace {
  std::uint32_t tile = 0;  ///< argument of LevelledScan::tile_at
  std::uint32_t key = 0;   ///< see VoxelKey
};

/// A scan in the world frame after levelling: which voxels its points are in.
class LevelledScan {
 public:
  /// Keeps references to the cloud and the result.
  LevelledScan(const LabelVoteConfig& config, CloudView cloud, const Segmentation& result,
               const Pose& pose, const Levelling& levelling) noexcept;

  /// Finds the points that vote, of those from `begin` on, at most GridPoints::capacity. Points
  /// beyond the tiles around the sensor do not vote.
  void read(std::size_t begin, GridPoints& voters) const noexcept {
    find_in_grid(scan_, filter_, grid_, begin, voters);
  }

  [[nodiscard]] VotePlace place_of(GridVoxel voxel) const noexcept {
    constexpr unsigned bits = VoxelKey::horizontal_bits;
    constexpr std::uint32_t mask = (1U << bits) - 1;
    const std::uint32_t column = voxel.column();
    const std::uint32_t row = voxel.row();
    return {.tile = (row >> bits) * static_cast<std::uint32_t>(side_) + (column >> bits),
            .key = VoxelKey::of(column & mask, row & mask, first_level_ + voxel.level())};
  }

  /// Number of tiles around the sensor.
  [[nodiscard]] std::size_t tiles() const noexcept { return side_ * side_; }
  [[nodiscard]] TileIndex tile_at(std::size_t place) const noexcept {
    return {.x = first_.x + static_cast<std::int64_t>(place % side_),
            .y = first_.y + static_cast<std::int64_t>(place / side_)};
  }

  /// The square of the horizontal distance from the voxel that contains the sensor to another one,
  /// m^2.
  [[nodiscard]] double squared_range(GridVoxel voxel) const noexcept {
    const double x = (voxel.column() - sensor_column_ + 0.5) * voxel_;
    const double y = (voxel.row() - sensor_row_ + 0.5) * voxel_;
    return x * x + y * y;
  }

 private:
  LabelledScan scan_;
  PointFilter filter_;
  WorldGrid grid_;
  double voxel_;                               // metres
  std::size_t side_;                           // number of tiles
  TileIndex first_;                            // the tile with the smallest x and y
  std::uint32_t first_level_;                  // of the grid, modulo 2^32
  double sensor_column_ = 0, sensor_row_ = 0;  // its voxel
};

}  // namespace flagstone
