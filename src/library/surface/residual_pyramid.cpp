// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "library/surface/residual_pyramid.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "library/surface/grid.hpp"

namespace flagstone::surface {
namespace {

/// Cells with fewer points are not observed.
constexpr std::size_t fewest_points_in_cell = 3;

/// Cells with at least this weight keep their own correction.
constexpr float full_weight = 0.5f;

/// Heights with less confidence are unknown.
constexpr float min_confidence = 1.0f / 16;

/// Number of cells per job.
constexpr std::size_t cells_of_a_job = 256;

/// Row and column of each cell of a block, by index along the Z-order curve.
struct InBlock {
  std::uint8_t row, column;
};
constexpr auto in_z_order = [] {
  std::array<InBlock, 1024> positions{};
  for (std::uint8_t row = 0; row < 32; ++row) {
    for (std::uint8_t column = 0; column < 32; ++column) {
      positions[z_order(column, row)] = {.row = row, .column = column};
    }
  }
  return positions;
}();

float reach_of(std::size_t level, const SquareCells& cells) {
  return std::min(levels[level].reach, cells.extent());
}

}  // namespace

ResidualPyramid::ResidualPyramid(const SurfaceConfig& config, const SquareCells& cells)
    : settings_(config.refinement) {
  const auto grid_count = static_cast<std::size_t>(std::max(settings_.levels, 1));
  std::size_t total = 0;
  std::size_t largest = 0;
  for (std::size_t level = 0; level < grid_count; ++level) {
    Grid grid{.cell = levels[level].cell};
    grid.width = static_cast<std::size_t>(std::lround(2 * reach_of(level, cells) / grid.cell));
    grids_.push_back(grid);
    total += grid.size();
    largest = std::max(largest, grid.size());
  }
  heights_.reserve(total);
  confidences_.reserve(total);
  corrections_.reserve(largest);
  weights_.reserve(largest);
  std::size_t first = 0;
  for (Grid& grid : grids_) {
    grid.heights = heights_.data() + first;
    grid.confidences = confidences_.data() + first;
    first += grid.size();
  }

  const auto level_total = static_cast<std::size_t>(settings_.levels);
  cells_.resize(level_total);
  for (std::size_t level = 0; level < level_total; ++level) {
    // All cells may be small, or none.
    cells_[level].small.reserve(grids_[level].size() + 1);
    cells_[level].large.reserve(grids_[level].size() + 1);
    cells_[level].first_block =
        static_cast<std::uint32_t>((cells.extent() - grids_[level].extent()) / block_size);
  }
  const int half = cells.half_blocks();
  for (int row = 0; row < 2 * half; ++row) {
    for (int column = 0; column < 2 * half; ++column) {
      const int ring = std::max({column - half, half - 1 - column, row - half, half - 1 - row});
      std::size_t reached = 0;
      while (reached < level_total &&
             static_cast<float>(ring * block_size) < levels[reached].reach) {
        ++reached;
      }
      blocks_.push_back({.cells = cells.block(column, row),
                         .column = static_cast<std::uint32_t>(column),
                         .row = static_cast<std::uint32_t>(row),
                         .levels = reached});
    }
  }
}

/// Lists the cells of all levels, block by block.
void ResidualPyramid::list_cells(const plane_fits::BinGroups& groups) noexcept {
  for (LevelCells& level : cells_) level.small_count = level.large_count = 0;
  for (const Block& block : blocks_) {
    if (groups.points(block.cells.first, block.cells.last).size() < fewest_points_in_cell) continue;
    groups.list_begins(block.cells.first, block.cells.last, begins_.data());
    for (std::size_t level = 0; level < block.levels; ++level) list_cells_of(block, level);
  }
}

void ResidualPyramid::list_cells_of(const Block& block, std::size_t level) noexcept {
  LevelCells& list = cells_[level];
  const auto along = static_cast<std::uint32_t>(block_size / levels[level].cell);
  const std::size_t each = (block.cells.last - block.cells.first) / (along * along);
  const std::uint32_t first_row = (block.row - list.first_block) * along;
  const std::uint32_t first_column = (block.column - list.first_block) * along;
  OccupiedCell* small = list.small.data() + list.small_count;
  OccupiedCell* large = list.large.data() + list.large_count;
  for (std::uint32_t index = 0; index < along * along; ++index) {
    const std::uint32_t first = begins_[index * each];
    const std::uint32_t count = begins_[(index + 1) * each] - first;
    const OccupiedCell cell{.first = first,
                            .count = count,
                            .row = first_row + in_z_order[index].row,
                            .column = first_column + in_z_order[index].column};
    // Without branches, because the number of points in a cell is hard to predict.
    *small = *large = cell;
    small += static_cast<std::ptrdiff_t>(count >= fewest_points_in_cell && count <= small_cell);
    large += static_cast<std::ptrdiff_t>(count > small_cell);
  }
  list.small_count = static_cast<std::size_t>(small - list.small.data());
  list.large_count = static_cast<std::size_t>(large - list.large.data());
}

void ResidualPyramid::refine(const plane_fits::BinGroups& groups, PullPush& pull_push,
                             ThreadPool& pool) noexcept {
  list_cells(groups);
  for (std::size_t level = 0; level < cells_.size(); ++level) {
    const Grid& grid = grids_[level];
    if (level > 0) upsample(grids_[level - 1], grid);
    std::fill_n(corrections_.data(), grid.size(), 0.0f);
    std::fill_n(weights_.data(), grid.size(), 0.0f);
    observe_level(level, groups, pool);
    pull_push.fill(corrections_.data(), weights_.data(), grid.width, full_weight);
    const bool inner = level > 0 && grid.extent() < grids_[level - 1].extent();
    correct(corrections_.data(), weights_.data(), inner, grid);
  }
}

float ResidualPyramid::gate_of(std::size_t level) const noexcept {
  float gate =
      settings_.gate;  // multiplied step by step, because std::pow differs between platforms
  for (std::size_t i = 0; i < level; ++i) gate *= settings_.gate_factor;
  return gate;
}

void ResidualPyramid::observe_level(std::size_t level, const plane_fits::BinGroups& groups,
                                    ThreadPool& pool) noexcept {
  const Observations observations{.points = groups.points(0, 0).data(),
                                  .surface = &grids_[level],
                                  .gate = gate_of(level),
                                  .gate_per_metre = settings_.gate_per_metre,
                                  .max_clutter_ratio = settings_.max_clutter_ratio,
                                  .lower_bound_weight = settings_.lower_bound_weight,
                                  .corrections = corrections_.data(),
                                  .weights = weights_.data()};
  const LevelCells& list = cells_[level];
  const auto jobs_of = [](std::size_t count) {
    return (count + cells_of_a_job - 1) / cells_of_a_job;
  };
  const std::size_t large_jobs = jobs_of(list.large_count);
  pool.run(large_jobs + jobs_of(list.small_count), [&](std::size_t, std::size_t job) {
    const bool large = job < large_jobs;
    const std::size_t first = (large ? job : job - large_jobs) * cells_of_a_job;
    const std::size_t count = large ? list.large_count : list.small_count;
    const OccupiedCell* const cells = large ? list.large.data() : list.small.data();
    observe(observations, {cells + first, std::min(cells_of_a_job, count - first)},
            large ? CellSize::any : CellSize::small);
  });
}

std::size_t ResidualPyramid::most_cells_along() const noexcept {
  return std::ranges::max(grids_, {}, &Grid::width).width;
}

void ResidualPyramid::reserve(GroundSurface& surface) const {
  std::vector<GroundSurface::Grid>& copies = surface.start();
  copies.resize(grids_.size());
  for (std::size_t i = 0; i < copies.size(); ++i) {
    copies[i].cell = grids_[i].cell;
    copies[i].width = grids_[i].width;
    copies[i].heights.resize(grids_[i].size());
    copies[i].confidences.resize(grids_[i].size());
  }
}

void ResidualPyramid::copy_to(GroundSurface& surface) const noexcept {
  std::vector<GroundSurface::Grid>& copies = surface.start();
  for (std::size_t i = 0; i < copies.size(); ++i) {
    const Grid& grid = grids_[i];
    for (std::size_t k = 0; k < grid.size(); ++k) {
      if (grid.confidences[k] >= min_confidence) continue;
      grid.heights[k] = std::numeric_limits<float>::quiet_NaN();
      grid.confidences[k] = 0;
    }
    std::copy_n(grid.heights, grid.size(), copies[i].heights.data());
    std::copy_n(grid.confidences, grid.size(), copies[i].confidences.data());
  }
}

}  // namespace flagstone::surface
