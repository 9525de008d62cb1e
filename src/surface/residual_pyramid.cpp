// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "surface/residual_pyramid.hpp"

#include <algorithm>
#include <cmath>

#include "surface/grid_steps.hpp"

namespace flagstone::surface {
namespace {

/// A cell with fewer points is not looked at.
constexpr std::size_t fewest_points = 3;

/// A cell whose observations weigh as much keeps its correction, whatever is around.
constexpr float full_weight = 0.5f;

/// Cells that one thread observes at a time.
constexpr std::size_t cells_of_a_job = 256;

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
  std::size_t most_cells = 0;
  for (std::size_t level = 0; level < static_cast<std::size_t>(settings_.levels); ++level) {
    plan_level(level, cells);
    most_cells = std::max(most_cells, plans_.back().cells.size());
  }
  occupied_.reserve(most_cells);
}

void ResidualPyramid::plan_level(std::size_t level, const SquareCells& cells) {
  LevelPlan& plan = plans_.emplace_back();
  const int reach = static_cast<int>(reach_of(level, cells)) / block_size;  // blocks
  const auto along = static_cast<std::uint32_t>(std::lround(block_size / levels[level].cell));
  for (int row = 0; row < 2 * reach; ++row) {
    for (int column = 0; column < 2 * reach; ++column) {
      const int inside = cells.half_blocks() - reach;
      const CellRange block = cells.block(column + inside, row + inside);
      const std::uint32_t each = (block.last - block.first) / (along * along);
      const auto first = static_cast<std::uint32_t>(plan.cells.size());
      plan.cells.resize(first + std::size_t{along} * along);
      for (std::uint32_t y = 0; y < along; ++y) {
        for (std::uint32_t x = 0; x < along; ++x) {
          const std::uint32_t place = z_order(x, y);  // a square's cells come first as a whole
          plan.cells[first + place] = {
              .cells = {block.first + place * each, block.first + (place + 1) * each},
              .row = static_cast<std::uint16_t>(static_cast<std::uint32_t>(row) * along + y),
              .column = static_cast<std::uint16_t>(static_cast<std::uint32_t>(column) * along + x)};
        }
      }
      plan.blocks.push_back(
          {.cells = block, .first = first, .last = static_cast<std::uint32_t>(plan.cells.size())});
    }
  }
}

std::span<const OccupiedCell> ResidualPyramid::occupied_cells(
    const LevelPlan& plan, const patches::BinGroups& groups) noexcept {
  const patches::MovedPoint* const all = groups.points(0, 0).data();
  OccupiedCell* end = occupied_.data();
  for (const LevelBlock& block : plan.blocks) {
    if (groups.points(block.cells.first, block.cells.last).size() < fewest_points) continue;
    for (std::uint32_t i = block.first; i < block.last; ++i) {
      const LevelCell& cell = plan.cells[i];
      const auto points = groups.points(cell.cells.first, cell.cells.last);
      if (points.size() < fewest_points) continue;
      *end++ = {.first = static_cast<std::uint32_t>(points.data() - all),
                .count = static_cast<std::uint32_t>(points.size()),
                .row = cell.row,
                .column = cell.column};
    }
  }
  return {occupied_.data(), end};
}

void ResidualPyramid::refine(const patches::BinGroups& groups, PullPush& pull_push,
                             Crew& crew) noexcept {
  for (std::size_t level = 0; level < plans_.size(); ++level) {
    if (level > 0) upsample(grids_[level - 1], grids_[level]);
    refine_level(level, groups, pull_push, crew);
  }
}

void ResidualPyramid::refine_level(std::size_t level, const patches::BinGroups& groups,
                                   PullPush& pull_push, Crew& crew) noexcept {
  const Grid& grid = grids_[level];
  std::fill_n(corrections_.data(), grid.size(), 0.0f);
  std::fill_n(weights_.data(), grid.size(), 0.0f);
  const std::span<const OccupiedCell> cells = occupied_cells(plans_[level], groups);
  const Observations observations{
      .points = groups.points(0, 0).data(),
      .surface = &grid,
      .gate = settings_.gate * std::pow(settings_.gate_factor, static_cast<float>(level)),
      .gate_growth = settings_.gate_growth,
      .contrast = settings_.contrast,
      .lower_bound_weight = settings_.lower_bound_weight,
      .corrections = corrections_.data(),
      .weights = weights_.data()};
  const std::size_t jobs = (cells.size() + cells_of_a_job - 1) / cells_of_a_job;
  crew.run(jobs, [&](std::size_t, std::size_t job) {
    const std::size_t first = job * cells_of_a_job;
    observe(observations, cells.subspan(first, std::min(cells_of_a_job, cells.size() - first)));
  });
  pull_push.fill(corrections_.data(), weights_.data(), grid.width, full_weight);
  const bool inner = level > 0 && grid.extent() < grids_[level - 1].extent();
  correct(corrections_.data(), weights_.data(), inner, grid);
}

}  // namespace flagstone::surface
