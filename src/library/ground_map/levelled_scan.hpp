// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "flagstone/cloud_view.hpp"
#include "flagstone/ground_map.hpp"
#include "flagstone/label_vote.hpp"
#include "flagstone/segmentation.hpp"
#include "library/ground_map/grid_points.hpp"

namespace flagstone {

/// The voxels of consecutive points of a scan.
struct PointVoxels {
  static constexpr std::size_t capacity = GridPoints::capacity;

  [[nodiscard]] std::size_t count() const noexcept { return points.count; }
  [[nodiscard]] bool votes(std::size_t i) const noexcept { return points.inside(i); }

  GridPoints points;
  // Only of points that vote.
  std::array<std::uint32_t, capacity> tile;  ///< argument of LevelledScan::tile_at
  std::array<std::uint32_t, capacity> key;   ///< see VoxelKey
};

/// A scan in the world frame after levelling: which voxels its points are in.
class LevelledScan {
 public:
  /// Keeps references to the cloud and the result.
  LevelledScan(const LabelVoteConfig& config, CloudView cloud, const Segmentation& result,
               const Pose& pose, const Levelling& levelling) noexcept;

  /// Number of tiles around the sensor.
  [[nodiscard]] std::size_t tiles() const noexcept { return side_ * side_; }
  [[nodiscard]] TileIndex tile_at(std::size_t place) const noexcept {
    return {.x = first_.x + static_cast<std::int64_t>(place % side_),
            .y = first_.y + static_cast<std::int64_t>(place / side_)};
  }

  /// The square of the horizontal distance from the voxel that contains the sensor to another one,
  /// m^2.
  [[nodiscard]] double squared_range(std::uint32_t tile, std::uint32_t key) const noexcept;

  /// Finds the voxels of the points from `begin` on, at most PointVoxels::capacity. Points beyond
  /// the tiles around the sensor do not vote.
  void read(std::size_t begin, PointVoxels& voxels) const noexcept;

 private:
  CloudView cloud_;
  const Segmentation& result_;
  PointFilter filter_;
  WorldGrid grid_;
  double voxel_;                               // metres
  std::size_t side_;                           // number of tiles
  TileIndex first_;                            // the tile with the smallest x and y
  double sensor_column_ = 0, sensor_row_ = 0;  // its voxel
};

}  // namespace flagstone
