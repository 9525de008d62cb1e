// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/baselines/usable_points.hpp"

#include <algorithm>
#include <cmath>

namespace flagstone::baselines {

void UsablePoints::reserve(std::size_t points) {
  if (points <= capacity_) return;
  capacity_ = 0;  // what holds if one of the next two throws
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
    const bool finite = p.x * 0 + p.y * 0 + p.z * 0 == 0;  // infinity * 0 and NaN are NaN
    if (!finite || (p.x == 0 && p.y == 0 && p.z == 0)) {
      labels[i] = Label::invalid;
    } else if (std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) > max_coordinate) {
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
