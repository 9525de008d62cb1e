// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/baselines/usable_points.hpp"

#include "library/core/point_validity.hpp"

namespace flagstone::baselines {

void UsablePoints::reserve(std::size_t points) {
  if (points <= capacity_) return;
  capacity_ = 0;  // correct if one of the next two lines throws
  coordinates_.reserve(3 * points);
  index_.reserve(points);
  capacity_ = points;
}

void UsablePoints::gather(CloudView cloud, std::span<Label> labels) noexcept {
  float* x = coordinates_.data();
  float* y = x + capacity_;
  float* z = y + capacity_;
  std::size_t n = 0;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Point p = cloud[i];
    if (!is_valid(p)) {
      labels[i] = Label::invalid;
    } else if (!is_within_limit(p)) {
      labels[i] = Label::out_of_range;
    } else {
      x[n] = p.x;
      y[n] = p.y;
      z[n] = p.z;
      index_.data()[n++] = static_cast<std::uint32_t>(i);
    }
  }
  size_ = n;
}

void UsablePoints::remove_below(float height, Label label, std::span<Label> labels) noexcept {
  float* x = coordinates_.data();
  float* y = x + capacity_;
  float* z = y + capacity_;
  std::uint32_t* index = index_.data();
  std::size_t kept = 0;
  for (std::size_t i = 0; i < size_; ++i) {
    if (z[i] < height) {
      labels[index[i]] = label;
      continue;
    }
    x[kept] = x[i];
    y[kept] = y[i];
    z[kept] = z[i];
    index[kept++] = index[i];
  }
  size_ = kept;
}

}  // namespace flagstone::baselines
