// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/baselines/cascaded_range_image.hpp"

#include <algorithm>
#include <cmath>

namespace flagstone::baselines {

RangeImage::RangeImage(const Beams& beams, const CascadedConfig& config)
    : rings_(beams.count()),
      min_object_height_(config.min_object_height),
      cells_(rings_ * static_cast<std::size_t>(config.columns)) {}

void RangeImage::clear() noexcept { std::ranges::fill(cells_, Cell{}); }

void RangeImage::add(std::size_t cell, float range, float height) noexcept {
  if (!cells_[cell].occupied) cells_[cell] = {range, height, true, false};
}

void RangeImage::find_upright(const Beams& beams) noexcept {
  for (std::size_t begin = 0; begin < cells_.size(); begin += rings_) {
    search_column(cells_.data() + begin, beams);
  }
}

void RangeImage::search_column(Cell* column, const Beams& beams) const noexcept {
  std::size_t ring = 0;
  while (ring < rings_ && !column[ring].occupied) ++ring;
  if (ring == rings_) return;
  Group group{ring, ring, column[ring].height, column[ring].height};
  for (++ring; ring < rings_; ++ring) {
    const Cell& next = column[ring];
    if (!next.occupied) continue;
    const float distance = std::abs(next.range - column[group.last].range);
    if (distance < beams.least_distance(group.last, ring)) {
      group.last = ring;
      group.lowest = std::min(group.lowest, next.height);
      group.highest = std::max(group.highest, next.height);
    } else {
      mark(column, group);
      group = {ring, ring, next.height, next.height};
    }
  }
  mark(column, group);
}

void RangeImage::mark(Cell* column, const Group& group) const noexcept {
  if (!(group.highest - group.lowest > min_object_height_)) return;
  for (std::size_t ring = group.first; ring <= group.last; ++ring) column[ring].upright = true;
}

}  // namespace flagstone::baselines
