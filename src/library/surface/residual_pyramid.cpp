// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "library/surface/residual_pyramid.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "library/surface/grid.hpp"

namespace flagstone::surface {
namespace {

/// Cells with at least this weight keep their own correction.
constexpr float full_weight = 0.5f;

/// Larger gates have the effect of this one, in units of a packed z.
constexpr float most_gate = 20 * z_per_metre;

/// Heights with less confidence are unknown.
constexpr float min_confidence = 1.0f / 16;

/// Elements that vectors can read or write after the last one.
constexpr std::size_t slack = 16;

/// Number of cells per job.
constexpr std::size_t cells_of_a_job = 256;

std::size_t jobs_of(std::size_t cells) { return (cells + cells_of_a_job - 1) / cells_of_a_job; }

/// Number of levels whose cells are large enough for a separate slope.
constexpr std::size_t tilted_levels = 2;

/// A point is in the upper half of a cell of the coarsest level if this bit of x or y is set.
constexpr int coarsest_half_bit = 7;

float reach_of(std::size_t level, const SquareCells& cells) {
  return std::min(levels[level].reach, cells.extent());
}

}  // namespace

ResidualPyramid::ResidualPyramid(const SurfaceConfig& config, const SquareCells& cells)
    : settings_(config.refinement), packed_zero_(cells.packed_zero()) {
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
  const std::size_t readable = total + grids_.front().width + slack;
  heights_.reserve(readable);
  confidences_.reserve(total + slack);
  corrections_.reserve(largest);
  weights_.reserve(largest);
  const std::size_t most_jobs = jobs_of(largest) + cell_sizes;
  unclear_counts_.reserve(most_jobs);
  unclear_.reserve(most_jobs * cells_of_a_job);
  candidates_.reserve(largest);
  slopes_.reserve(largest + slack);
  offsets_.reserve(largest + slack);
  gates_.reserve(total);
  std::fill_n(heights_.data(), readable, 0.0f);
  std::fill_n(corrections_.data(), largest, 0.0f);
  std::fill_n(weights_.data(), largest, 0.0f);
  std::size_t first = 0;
  for (Grid& grid : grids_) {
    grid.heights = heights_.data() + first;
    grid.confidences = confidences_.data() + first;
    first += grid.size();
  }

  const auto level_total = static_cast<std::size_t>(settings_.levels);
  cells_.resize(level_total);
  for (std::size_t level = 0; level < level_total; ++level) {
    const Grid& grid = grids_[level];
    cells_[level].lists.reserve(grid.size());
    const auto along = static_cast<std::size_t>(block_size / levels[level].cell);
    for (std::size_t index = 0; index < along * along; ++index) {
      const InBlock place = in_z_order[index];
      cells_[level].places.push_back(
          static_cast<std::uint32_t>(place.row * grid.width + place.column));
    }
    std::int16_t* const gates = gates_.data() + (grid.heights - heights_.data());
    cells_[level].gates = gates;
    for (std::size_t row = 0; row < grid.width; ++row) {
      for (std::size_t column = 0; column < grid.width; ++column) {
        const float x = grid.center(column);
        const float y = grid.center(row);
        const float gate = gate_of(level) + settings_.gate_per_metre * std::sqrt(x * x + y * y);
        gates[row * grid.width + column] =
            static_cast<std::int16_t>(std::min(gate * z_per_metre, most_gate));
      }
    }
  }
  list_blocks(cells);
}

/// Lists the blocks of each level.
void ResidualPyramid::list_blocks(const SquareCells& cells) {
  const int half = cells.half_blocks();
  for (int row = 0; row < 2 * half; ++row) {
    for (int column = 0; column < 2 * half; ++column) {
      const int ring = std::max({column - half, half - 1 - column, row - half, half - 1 - row});
      const CellRange range = cells.block(column, row);
      for (std::size_t level = 0; level < cells_.size(); ++level) {
        if (static_cast<float>(ring * block_size) >= levels[level].reach) break;
        const Grid& grid = grids_[level];
        const int first_block = static_cast<int>((cells.extent() - grid.extent()) / block_size);
        const int along = static_cast<int>(block_size / grid.cell);
        const int place = (row - first_block) * along * static_cast<int>(grid.width) +
                          (column - first_block) * along;
        LevelBlock block{
            .first_cell = range.first, .step = 1, .first_place = static_cast<std::uint32_t>(place)};
        if (level == 0) {
          block.first_cell =
              static_cast<std::uint32_t>(row * 2 * half + column) * coarse_cells_of_block;
        } else {
          block.step =
              (range.last - range.first) / static_cast<std::uint32_t>(cells_[level].places.size());
        }
        cells_[level].blocks.push_back(block);
      }
    }
  }
}

void ResidualPyramid::refine(const PackedPoints& points, const CoarseSamples& samples,
                             PullPush& pull_push, ThreadPool& pool) noexcept {
  for (std::size_t level = 0; level < cells_.size(); ++level) {
    const Grid& grid = grids_[level];
    if (level > 0) upsample(grids_[level - 1], grid);
    LevelCells& cells = cells_[level];
    cells.lists.list(cells.blocks, cells.places, level == 0 ? samples.begins() : points.begins());
    observe_level(level, level == 0 ? samples.data() : points.data(), pool);
    const bool inner = level > 0 && grid.extent() < grids_[level - 1].extent();
    pull_push.correct(corrections_.data(), weights_.data(), full_weight, inner, grid);
  }
}

float ResidualPyramid::gate_of(std::size_t level) const noexcept {
  float gate =
      settings_.gate;  // multiplied step by step, because std::pow differs between platforms
  for (std::size_t i = 0; i < level; ++i) gate *= settings_.gate_factor;
  return gate;
}

void ResidualPyramid::observe_level(std::size_t level, const PackedPoint* points,
                                    ThreadPool& pool) noexcept {
  const CellPlanes planes{.slopes = slopes_.data(), .offsets = offsets_.data()};
  find_planes(grids_[level], packed_zero_, planes);
  const float gate = gate_of(level);
  const Observations observations{
      .points = points,
      .planes = planes,
      .gates = cells_[level].gates,
      .second_look = level < tilted_levels ? SecondLook::tilted : SecondLook::wide,
      .half_bit = coarsest_half_bit - static_cast<int>(level),
      .widening = static_cast<std::int16_t>((settings_.gate - gate) * z_per_metre),
      .max_clutter_ratio = settings_.max_clutter_ratio,
      .lower_bound_weight = settings_.lower_bound_weight,
      .corrections = corrections_.data(),
      .weights = weights_.data()};
  std::array<OccupiedCells, cell_sizes> lists;
  std::array<std::size_t, cell_sizes> jobs;
  for (std::size_t size = 0; size < cell_sizes; ++size) {
    lists[size] = cells_[level].lists.cells(static_cast<CellSize>(size));
    jobs[size] = jobs_of(lists[size].size);
  }
  const std::size_t job_count = jobs[0] + jobs[1] + jobs[2];
  // Large cells take longest, so they come first.
  pool.run(job_count, [&](std::size_t, std::size_t job) {
    std::size_t size = cell_sizes - 1;
    std::size_t of_size = job;
    while (of_size >= jobs[size]) of_size -= jobs[size--];
    const OccupiedCells cells = lists[size].part(of_size * cells_of_a_job, cells_of_a_job);
    unclear_counts_.data()[job] = static_cast<std::uint32_t>(observe(
        observations, cells, static_cast<CellSize>(size), unclear_.data() + job * cells_of_a_job));
  });

  std::size_t count = 0;
  for (std::size_t job = 0; job < job_count; ++job) {
    const std::size_t unclear = unclear_counts_.data()[job];
    std::copy_n(unclear_.data() + job * cells_of_a_job, unclear, unclear_.data() + count);
    count += unclear;
  }
  look_again(observations, {unclear_.data(), count}, grids_[level].width, pool);
}

/// Observes cells a second time and adds the corrections.
void ResidualPyramid::look_again(const Observations& observations,
                                 std::span<const OccupiedCell> cells, std::size_t width,
                                 ThreadPool& pool) noexcept {
  const std::span<Candidate> candidates(candidates_.data(), cells.size());
  pool.run(jobs_of(cells.size()), [&](std::size_t, std::size_t job) {
    const std::size_t first = job * cells_of_a_job;
    const std::size_t count = std::min(cells_of_a_job, cells.size() - first);
    observe_again(observations, cells.subspan(first, count), candidates.data() + first);
  });
  const Corrections corrections{
      .values = corrections_.data(), .weights = weights_.data(), .width = width};
  if (observations.second_look == SecondLook::tilted) {
    accept(candidates, corrections);
  } else {
    accept_confirmed(candidates, corrections);
  }
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

void ResidualPyramid::finish(GroundSurface& surface) noexcept {
  std::vector<GroundSurface::Grid>& copies = surface.start();
  for (std::size_t i = 0; i < copies.size(); ++i) {
    surface::finish(grids_[i], min_confidence, copies[i].heights.data(),
                    copies[i].confidences.data());
  }
}

}  // namespace flagstone::surface
