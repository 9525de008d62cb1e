// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "clouds.hpp"
#include "flagstone/cloud_view.hpp"
#include "flagstone/label.hpp"
#include "flagstone/surface_config.hpp"
#include "library/core/thread_pool.hpp"
#include "library/plane_fits/bin_batch.hpp"
#include "library/plane_fits/bin_groups.hpp"
#include "library/plane_fits/scan_points.hpp"
#include "library/surface/cell_observations.hpp"
#include "library/surface/grid.hpp"
#include "library/surface/point_heights.hpp"
#include "library/surface/pull_push.hpp"
#include "library/surface/residual_pyramid.hpp"
#include "library/surface/square_cells.hpp"
#include "library/surface/square_patches.hpp"

namespace flagstone::performance {

/// A scan after every step of the method surface, so that each can be done again.
///
/// The surface that points are measured from began as level ground below the sensor: the planes of
/// patches, which the steps shared with Patchwork find, are left out.
class SurfaceSteps {
 public:
  explicit SurfaceSteps(Cloud points);

  void read();
  void group();

  /// Points that sample() takes of all patches.
  [[nodiscard]] std::size_t sampled_points() const noexcept { return sampled_points_; }
  void sample();

  /// Cells of a level that hold enough points to be observed.
  [[nodiscard]] std::size_t occupied_cells(std::size_t level) const noexcept {
    return occupied_[level].size();
  }
  void observe(std::size_t level);

  /// Cells of the coarsest grid, which has most.
  [[nodiscard]] std::size_t filled_cells() const noexcept {
    return pyramid_.grids().front().size();
  }
  /// Fills the gaps between those of them that were observed.
  void fill();

  /// All levels, from level ground.
  void refine();

  void measure();
  void label();

  Cloud cloud;

 private:
  void find_occupied(std::size_t level);

  SurfaceConfig config_;
  surface::SquareCells cells_;
  surface::SquarePatches patches_;
  surface::ResidualPyramid pyramid_;
  surface::PullPush pull_push_;
  surface::PointHeights point_heights_;
  ThreadPool crew_{1};
  plane_fits::ScanPoints scan_;
  plane_fits::BinGroups groups_{plane_fits::Listing::points};
  plane_fits::BinBatch batch_;
  std::size_t sampled_points_ = 0;
  std::array<std::vector<surface::OccupiedCell>, surface::level_count> occupied_;
  std::vector<float> corrections_, weights_;             ///< of the level observed last
  std::vector<float> values_to_fill_, weights_to_fill_;  ///< of the coarsest level
  std::vector<float> values_, confidences_;              ///< the same, filled
  std::vector<float> heights_;
  std::vector<Label> labels_;
};

}  // namespace flagstone::performance
