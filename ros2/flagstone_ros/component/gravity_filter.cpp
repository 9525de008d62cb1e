// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "gravity_filter.hpp"

#include <cmath>
#include <cstddef>

namespace flagstone_ros {
namespace {

double length_of(const Vector& v) { return std::hypot(v[0], v[1], v[2]); }

}  // namespace

bool GravityFilter::add(const Vector& acceleration, double stamp, std::string_view frame,
                        double time_constant) {
  const double length = length_of(acceleration);
  if (!std::isfinite(length) || !(length > 0)) return false;
  const double step = stamp - stamp_;
  const bool starts = !has_started_ || std::abs(step) > max_gap || frame != frame_;
  if (!starts && step < 0) return false;
  const double weight = starts || !(time_constant > 0) ? 1 : 1 - std::exp(-step / time_constant);
  for (std::size_t i = 0; i < mean_.size(); ++i) mean_[i] += weight * (acceleration[i] - mean_[i]);
  if (starts) mean_ = acceleration;
  stamp_ = stamp;
  frame_ = frame;
  has_started_ = true;
  return true;
}

std::optional<Vector> GravityFilter::up() const {
  if (!has_started_ || !(length_of(mean_) > 0)) return std::nullopt;
  return mean_;
}

}  // namespace flagstone_ros
