// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "surface_steps.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <utility>

#include "library/core/plane.hpp"
#include "library/surface/read_scan.hpp"

namespace flagstone::performance {

using plane_fits::ScanPoints;

namespace {

constexpr std::size_t most_samples = 128;  // of a patch, as the pipeline takes
constexpr std::size_t fewest_points = 11;  // of a patch that is fitted
constexpr std::size_t fewest_in_cell = 3;  // of a cell that is observed
constexpr float full_weight = 0.5f;

std::size_t widest(std::span<const surface::Grid> grids) {
  return std::ranges::max(grids, {}, &surface::Grid::width).width;
}

}  // namespace

SurfaceSteps::SurfaceSteps(Cloud points)
    : cloud(std::move(points)),
      cells_(config_),
      patches_(config_, cells_),
      pyramid_(config_, cells_),
      pull_push_(widest(pyramid_.grids())),
      point_heights_(config_, cells_),
      heights_(cloud.size()),
      labels_(cloud.size()) {
  scan_.reserve(cloud.size());
  groups_.reserve(cloud.size(), cells_.group_count());
  batch_.reserve(batch_size * most_samples);
  read();
  group();
  for (std::size_t level = 0; level < surface::level_count; ++level) find_occupied(level);
  refine();
  observe(0);
  values_to_fill_ = corrections_;
  weights_to_fill_ = weights_;
  fill();
  measure();
  sample();
}

void SurfaceSteps::read() {
  for (std::size_t chunk = 0; chunk < ScanPoints::chunk_count(cloud.size()); ++chunk) {
    surface::read_chunk(view_of(cloud), chunk, cells_, scan_);
  }
}

void SurfaceSteps::group() { groups_.group(scan_, cloud.size(), cells_.group_count()); }

void SurfaceSteps::sample() {
  sampled_points_ = 0;
  batch_.clear();
  for (std::uint32_t i = 0; i < patches_.list().size(); ++i) {
    const surface::CellRange& range = patches_.list()[i].cells;
    const auto points = groups_.points(range.first, range.last);
    if (points.size() < fewest_points) continue;
    if (batch_.count() == batch_size) batch_.clear();
    batch_.add_sample(i, points, most_samples);
    sampled_points_ += batch_.size(batch_.count() - 1);
  }
}

void SurfaceSteps::find_occupied(std::size_t level) {
  const surface::Grid& grid = pyramid_.grids()[level];
  const auto along = static_cast<std::uint32_t>(std::lround(surface::block_size / grid.cell));
  const auto blocks = static_cast<int>(grid.width / along);  // along a side
  const int edge = cells_.half_blocks() - blocks / 2;
  const plane_fits::MovedPoint* const all = groups_.points(0, 0).data();
  for (int row = 0; row < blocks; ++row) {
    for (int column = 0; column < blocks; ++column) {
      const surface::CellRange block = cells_.block(edge + column, edge + row);
      const std::uint32_t each = (block.last - block.first) / (along * along);
      for (std::uint32_t y = 0; y < along; ++y) {
        for (std::uint32_t x = 0; x < along; ++x) {
          const std::uint32_t first = block.first + surface::z_order(x, y) * each;
          const auto points = groups_.points(first, first + each);
          if (points.size() < fewest_in_cell) continue;
          occupied_[level].push_back({.first = static_cast<std::uint32_t>(points.data() - all),
                                      .count = static_cast<std::uint32_t>(points.size()),
                                      .row = static_cast<std::uint32_t>(row) * along + y,
                                      .column = static_cast<std::uint32_t>(column) * along + x});
        }
      }
    }
  }
  std::ranges::sort(occupied_[level], {}, &surface::OccupiedCell::first);
}

void SurfaceSteps::observe(std::size_t level) {
  const surface::Grid& grid = pyramid_.grids()[level];
  corrections_.assign(grid.size(), 0.0f);
  weights_.assign(grid.size(), 0.0f);
  const Refinement& settings = config_.refinement;
  surface::observe(
      {.points = groups_.points(0, 0).data(),
       .surface = &grid,
       .gate = settings.gate * std::pow(settings.gate_factor, static_cast<float>(level)),
       .gate_per_metre = settings.gate_per_metre,
       .max_clutter_ratio = settings.max_clutter_ratio,
       .lower_bound_weight = settings.lower_bound_weight,
       .corrections = corrections_.data(),
       .weights = weights_.data()},
      occupied_[level], surface::CellSize::any);
}

void SurfaceSteps::fill() {
  values_ = values_to_fill_;
  confidences_ = weights_to_fill_;
  pull_push_.fill(values_.data(), confidences_.data(), pyramid_.grids().front().width, full_weight);
}

void SurfaceSteps::refine() {
  const surface::Grid& grid = pyramid_.grids().front();
  std::fill_n(grid.heights, grid.size(), -config_.sensor_height);
  std::fill_n(grid.confidences, grid.size(), 1.0f);
  pyramid_.refine(groups_, pull_push_, crew_);
}

void SurfaceSteps::measure() {
  point_heights_.set_surface(pyramid_.grids());
  for (std::size_t chunk = 0; chunk < ScanPoints::chunk_count(cloud.size()); ++chunk) {
    point_heights_.measure(scan_, chunk, heights_);
  }
}

void SurfaceSteps::label() {
  surface::LabelTotals totals{};
  for (std::size_t chunk = 0; chunk < ScanPoints::chunk_count(cloud.size()); ++chunk) {
    point_heights_.label(scan_, chunk, heights_, labels_, totals);
  }
}

}  // namespace flagstone::performance
