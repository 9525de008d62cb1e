// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "library/moving_points/moving_objects.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace flagstone {
namespace {

constexpr int width = MovingObjects::grid.width;
constexpr unsigned min_moving_points = 8;

// From a column to its eight neighbours.
constexpr std::array<int, 8> neighbours{-width - 1, -width,    -width + 1, -1,
                                        1,          width - 1, width,      width + 1};

std::uint32_t moved(std::uint32_t column, int by) noexcept {
  return static_cast<std::uint32_t>(static_cast<int>(column) + by);
}

void add(std::uint16_t& count, std::uint32_t by) noexcept {
  constexpr std::uint32_t max = std::numeric_limits<std::uint16_t>::max();
  count = static_cast<std::uint16_t>(std::min(count + by, max));
}

}  // namespace

// Calls `use(moving points, fixed points)` for each connected set of columns that belong, if one of
// them is a start; its columns are in component_. Starts must belong.
template <class Starts, class Belongs, class Use>
void MovingObjects::for_each_component(const Starts& starts, const Belongs& belongs,
                                       const Use& use) {
  ++visit_;
  for (const std::uint32_t start : used_) {
    if (cells_[start].visit == visit_ || !starts(cells_[start])) continue;
    component_.clear();
    open_.assign(1, start);
    cells_[start].visit = visit_;
    unsigned moving = 0;
    unsigned fixed = 0;
    while (!open_.empty()) {
      const std::uint32_t column = open_.back();
      open_.pop_back();
      component_.push_back(column);
      moving += cells_[column].moving;
      fixed += cells_[column].fixed;
      for (const int by : neighbours) {
        Cell& next = cells_[moved(column, by)];
        if (points_[moved(column, by)] == 0 || next.visit == visit_ || !belongs(next)) continue;
        next.visit = visit_;
        open_.push_back(moved(column, by));
      }
    }
    use(moving, fixed);
  }
}

// Connected columns with more moving than fixed points.
void MovingObjects::mark_seeds() {
  const auto is_mostly_moving = [](const Cell& cell) { return cell.moving > cell.fixed; };
  for_each_component(is_mostly_moving, is_mostly_moving, [&](unsigned moving, unsigned) {
    if (moving < min_moving_points) return;
    for (const std::uint32_t column : component_) cells_[column].is_moving = true;
  });
}

// Twice by one column, into columns whose points are not mostly fixed.
void MovingObjects::grow() {
  for (int round = 0; round < 2; ++round) {
    grown_.clear();
    for (const std::uint32_t column : used_) {
      const Cell& cell = cells_[column];
      if (cell.is_moving || 2 * cell.fixed > points_[column]) continue;
      if (std::ranges::any_of(neighbours,
                              [&](int by) { return cells_[moved(column, by)].is_moving; })) {
        grown_.push_back(column);
      }
    }
    for (const std::uint32_t column : grown_) cells_[column].is_moving = true;
  }
}

// Separate objects with more moving than fixed points.
void MovingObjects::mark_whole_components() {
  for_each_component([](const Cell& cell) { return cell.moving > 0; },
                     [](const Cell&) { return true; },
                     [&](unsigned moving, unsigned fixed) {
                       if (moving < min_moving_points || moving <= fixed) return;
                       for (const std::uint32_t column : component_) {
                         cells_[column].is_moving = true;
                       }
                     });
}

void MovingObjects::number_objects() {
  count_ = 0;
  const auto moves = [](const Cell& cell) { return cell.is_moving; };
  for_each_component(moves, moves, [&](unsigned, unsigned) {
    ++count_;
    for (const std::uint32_t column : component_) {
      cells_[column].object = static_cast<std::uint32_t>(count_);
    }
  });
}

void MovingObjects::start(std::span<const std::uint32_t> columns) {
  points_.resize(std::size_t{width} * width);
  cells_.resize(points_.size());
  for (const std::uint32_t column : used_) {
    points_[column] = 0;
    cells_[column] = {};
  }
  used_.clear();
  for (const std::uint32_t column : columns) {
    if (points_[column] == 0) used_.push_back(column);
    add(points_[column], 1);
  }
  std::ranges::sort(used_);
}

void MovingObjects::find(std::span<const Sample> samples) {
  for (const auto& [column, evidence] : samples) {
    Cell& cell = cells_[column];
    if (evidence == Evidence::moving) add(cell.moving, points_per_sample(column));
    if (evidence == Evidence::fixed) add(cell.fixed, points_per_sample(column));
  }
  visit_ = 0;
  mark_seeds();
  grow();
  mark_whole_components();
  number_objects();
}

}  // namespace flagstone
