// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/sim/cross_lines.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace flagstone::sim {
namespace {

constexpr double bucket_size = 2;  // metres

}  // namespace

CrossLines::CrossLines(std::vector<CrossLine> lines, Interval across, bool closed)
    : lines_(std::move(lines)), closed_(closed) {
  double high_x = lines_.front().x;
  double high_y = lines_.front().y;
  low_x_ = high_x;
  low_y_ = high_y;
  for (const CrossLine& line : lines_) {
    for (const double t : {across.low, across.high}) {
      const Vector3 end = line.at(t);
      low_x_ = std::min(low_x_, end.x - bucket_size);
      low_y_ = std::min(low_y_, end.y - bucket_size);
      high_x = std::max(high_x, end.x + bucket_size);
      high_y = std::max(high_y, end.y + bucket_size);
    }
  }
  width_ = static_cast<std::size_t>((high_x - low_x_) / bucket_size) + 1;
  depth_ = static_cast<std::size_t>((high_y - low_y_) / bucket_size) + 1;
  buckets_.assign(width_ * depth_, nothing);
  for (std::size_t i = 0; i < lines_.size(); ++i) {
    for (double t = across.low; t < across.high + bucket_size / 2; t += bucket_size / 2) {
      const Vector3 at = lines_[i].at(std::min(t, across.high));
      const auto column = static_cast<std::size_t>((at.x - low_x_) / bucket_size);
      const auto row = static_cast<std::size_t>((at.y - low_y_) / bucket_size);
      // The lines fan out by less than a bucket, so that the neighbours have no gaps.
      for (const std::size_t next : {row * width_ + column, row * width_ + column + 1,
                                     (row + 1) * width_ + column, (row + 1) * width_ + column + 1,
                                     row * width_ + column - 1, (row - 1) * width_ + column}) {
        if (next < buckets_.size() && buckets_[next] == nothing) {
          buckets_[next] = static_cast<std::uint32_t>(i);
        }
      }
    }
  }
}

std::size_t CrossLines::guess(double x, double y) const noexcept {
  const double column = std::floor((x - low_x_) / bucket_size);
  const double row = std::floor((y - low_y_) / bucket_size);
  if (column >= 0 && row >= 0 && column < static_cast<double>(width_) &&
      row < static_cast<double>(depth_)) {
    const std::uint32_t near =
        buckets_[static_cast<std::size_t>(row) * width_ + static_cast<std::size_t>(column)];
    if (near != nothing) return near;
  }
  const auto from = [x, y](const CrossLine& line) { return std::hypot(line.x - x, line.y - y); };
  return static_cast<std::size_t>(std::ranges::min_element(lines_, {}, from) - lines_.begin());
}

std::size_t CrossLines::before(double x, double y) const noexcept {
  const std::size_t strips = lines_.size() - 1;
  std::size_t at = std::min(guess(x, y), strips - 1);
  for (std::size_t step = 0; step < strips && lines_[at].ahead(x, y) < 0; ++step) {
    if (at == 0 && !closed_) return 0;
    at = at == 0 ? strips - 1 : at - 1;
  }
  for (std::size_t step = 0; step < strips && lines_[at + 1].ahead(x, y) >= 0; ++step) {
    if (at + 1 == strips && !closed_) return at;
    at = at + 1 == strips ? 0 : at + 1;
  }
  return at;
}

}  // namespace flagstone::sim
