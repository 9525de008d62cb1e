// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/baselines/line_fit_segments.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

namespace flagstone::baselines {
namespace {

/// Lines extend this far beyond their ends, metres; a constant of the public implementation.
constexpr float end_margin = 0.1f;

constexpr Prototype no_point = {-1, std::numeric_limits<float>::infinity()};
constexpr float no_line = -1;

/// Number of segments that begin within the search angle, on one side.
std::uint32_t steps_within(const LineFitConfig& config) {
  const double width = 360.0 / config.segments;
  const double steps = std::ceil(static_cast<double>(config.search_angle) / width) - 1;
  return static_cast<std::uint32_t>(std::clamp(steps, 0.0, config.segments / 2.0));
}

}  // namespace

LowestPoints::LowestPoints(const PolarGrid& grid)
    : segments_(grid.sectors()),
      bins_per_segment_(grid.rings()),
      lowest_(grid.bin_count()),
      segment_(grid.rings()) {}

void LowestPoints::collect(const UsablePoints& points, const float* ranges,
                           std::span<const std::uint32_t> bins) noexcept {
  std::ranges::fill(lowest_, no_point);
  for (std::size_t k = 0; k < points.size(); ++k) {
    if (bins[k] >= lowest_.size()) continue;
    Prototype& lowest = lowest_[bins[k]];
    const Prototype point = {ranges[k], points.z()[k]};
    if (std::tie(point.height, point.range) < std::tie(lowest.height, lowest.range)) lowest = point;
  }
}

std::span<const Prototype> LowestPoints::of_segment(std::uint32_t segment) noexcept {
  std::size_t count = 0;
  for (std::uint32_t bin = 0; bin < bins_per_segment_; ++bin) {
    const Prototype& lowest = lowest_[bin * segments_ + segment];
    if (lowest.range >= 0) segment_[count++] = lowest;
  }
  return {segment_.data(), count};
}

GroundLines::GroundLines(const PolarGrid& grid, const LineFitConfig& config)
    : config_(config),
      segments_(grid.sectors()),
      search_steps_(steps_within(config)),
      lines_(grid.bin_count()),
      first_line_(grid.sectors() + 1) {}

void GroundLines::extract(LowestPoints& lowest) noexcept {
  std::uint32_t count = 0;
  for (std::uint32_t segment = 0; segment < segments_; ++segment) {
    first_line_[segment] = count;
    count += static_cast<std::uint32_t>(
        extract_lines(lowest.of_segment(segment), config_, lines_.data() + count));
  }
  first_line_[segments_] = count;
}

float GroundLines::distance_within(std::uint32_t segment, float range,
                                   float height) const noexcept {
  // From the far end, so that the farther line is used if two lines meet.
  for (std::uint32_t i = first_line_[segment + 1]; i-- > first_line_[segment];) {
    const GroundLine& line = lines_[i];
    if (line.begin - end_margin < range && range < line.end + end_margin) {
      return std::abs(height - line.height_at(range));
    }
  }
  return no_line;
}

float GroundLines::distance(std::uint32_t segment, float range, float height) const noexcept {
  float distance = distance_within(segment, range, height);
  std::uint32_t left = segment;
  std::uint32_t right = segment;
  for (std::uint32_t step = 0; step < search_steps_ && distance == no_line; ++step) {
    left = left + 1 == segments_ ? 0 : left + 1;
    right = (right == 0 ? segments_ : right) - 1;
    distance =
        std::max(distance_within(left, range, height), distance_within(right, range, height));
  }
  return distance == no_line ? std::numeric_limits<float>::infinity() : distance;
}

}  // namespace flagstone::baselines
