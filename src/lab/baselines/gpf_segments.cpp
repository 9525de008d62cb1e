// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/baselines/gpf_segments.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace flagstone::baselines {

GpfSegments::GpfSegments(int count, float length)
    : count_(count),
      length_(length),
      ends_(static_cast<std::size_t>(count) + 1),
      next_(static_cast<std::size_t>(count)) {}

void GpfSegments::reserve(std::size_t points) {
  x_.reserve(points);
  y_.reserve(points);
  z_.reserve(points);
  index_.reserve(points);
}

int GpfSegments::segment_of(float x) const noexcept {
  const double segment = std::floor(static_cast<double>(x) / length_ + 0.5 * count_);
  return static_cast<int>(std::clamp(segment, 0.0, static_cast<double>(count_ - 1)));
}

void GpfSegments::sort(const UsablePoints& points) noexcept {
  std::ranges::fill(ends_, 0);
  for (const float x : points.x()) ++ends_[static_cast<std::size_t>(segment_of(x)) + 1];
  std::partial_sum(ends_.begin(), ends_.end(), ends_.begin());
  std::copy(ends_.begin(), ends_.end() - 1, next_.begin());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::size_t to = next_[static_cast<std::size_t>(segment_of(points.x()[i]))]++;
    x_.data()[to] = points.x()[i];
    y_.data()[to] = points.y()[i];
    z_.data()[to] = points.z()[i];
    index_.data()[to] = points.index()[i];
  }
}

Coordinates GpfSegments::points(int segment) const noexcept {
  const std::size_t first = begin(segment);
  const std::size_t n = size(segment);
  return {{x_.data() + first, n}, {y_.data() + first, n}, {z_.data() + first, n}};
}

std::span<const std::uint32_t> GpfSegments::index(int segment) const noexcept {
  return {index_.data() + begin(segment), size(segment)};
}

}  // namespace flagstone::baselines
