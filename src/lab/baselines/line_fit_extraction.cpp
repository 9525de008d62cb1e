// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/baselines/line_fit_extraction.hpp"

#include <algorithm>
#include <cmath>

namespace flagstone::baselines {
namespace {

/// The least-squares line through the points added so far. Ranges and heights are relative to the
/// first point, to avoid cancellation when squares are subtracted.
class LineSums {
 public:
  explicit LineSums(Prototype first) noexcept : origin_(first) { add(first); }

  void add(Prototype p) noexcept {
    const double r = static_cast<double>(p.range) - static_cast<double>(origin_.range);
    const double z = static_cast<double>(p.height) - static_cast<double>(origin_.height);
    count_ += 1;
    r_ += r;
    z_ += z;
    rr_ += r * r;
    rz_ += r * z;
  }

  /// Needs at least two points with different ranges.
  [[nodiscard]] GroundLine line(float end) const noexcept {
    const double slope = (count_ * rz_ - r_ * z_) / (count_ * rr_ - r_ * r_);
    const double height = (z_ - slope * r_) / count_;
    return {.begin = origin_.range,
            .end = end,
            .height = static_cast<float>(static_cast<double>(origin_.height) + height),
            .slope = static_cast<float>(slope)};
  }

 private:
  Prototype origin_;
  double count_ = 0, r_ = 0, z_ = 0, rr_ = 0, rz_ = 0;
};

float largest_residual(std::span<const Prototype> prototypes, const GroundLine& line) noexcept {
  float largest = 0;
  for (const Prototype& p : prototypes) {
    largest = std::max(largest, std::abs(p.height - line.height_at(p.range)));
  }
  return largest;
}

/// State of one call of extract_lines().
class Extraction {
 public:
  Extraction(std::span<const Prototype> prototypes, const LineFitConfig& config) noexcept
      : prototypes_(prototypes), config_(config) {}

  /// Whether a line can begin with prototypes `first` and `first` + 1 if the ground found so far
  /// ends at height `ground`, metres.
  [[nodiscard]] bool may_begin(std::size_t first, float ground) const noexcept {
    return gap_before(first + 1) < config_.long_gap &&
           std::abs(prototypes_[first].height - ground) < config_.max_start_height;
  }

  /// Extends a line from prototypes `first` and `first` + 1 as far as possible. Sets `line` and
  /// returns the index after its last point. If no third point fits, `line` is unchanged.
  [[nodiscard]] std::size_t grow(std::size_t first, GroundLine& line) const noexcept {
    LineSums sums(prototypes_[first]);
    sums.add(prototypes_[first + 1]);
    bool has_gap = false;
    std::size_t end = first + 2;
    for (; end < prototypes_.size(); ++end) {
      const Prototype next = prototypes_[end];
      has_gap = has_gap || gap_before(end) > config_.long_gap;
      if (has_gap && !continues(line, end - first, next)) break;
      sums.add(next);
      const GroundLine grown = sums.line(next.range);
      if (!is_ground(grown, prototypes_.subspan(first, end + 1 - first))) break;
      line = grown;
    }
    return end;
  }

 private:
  [[nodiscard]] float gap_before(std::size_t i) const noexcept {
    return prototypes_[i].range - prototypes_[i - 1].range;
  }

  /// Whether `next`, after a gap, lies on the extension of a line of `points` points.
  [[nodiscard]] bool continues(const GroundLine& line, std::size_t points,
                               Prototype next) const noexcept {
    return points >= 3 &&
           std::abs(next.height - line.height_at(next.range)) <= config_.max_gap_height;
  }

  /// The conditions on slope, intercept and fit error of algorithm 1.
  [[nodiscard]] bool is_ground(const GroundLine& line,
                               std::span<const Prototype> prototypes) const noexcept {
    const float slope = std::abs(line.slope);
    if (!(slope <= config_.max_slope)) return false;
    const float intercept = line.height_at(0) + config_.sensor_height;
    if (slope < config_.flat_slope && std::abs(intercept) > config_.max_intercept) return false;
    return largest_residual(prototypes, line) <= config_.max_fit_error;
  }

  std::span<const Prototype> prototypes_;
  const LineFitConfig& config_;
};

}  // namespace

std::size_t extract_lines(std::span<const Prototype> prototypes, const LineFitConfig& config,
                          GroundLine* lines) noexcept {
  const Extraction extraction(prototypes, config);
  float ground = -config.sensor_height;
  std::size_t count = 0;
  std::size_t first = 0;
  while (first + 2 < prototypes.size()) {
    if (!extraction.may_begin(first, ground)) {
      ++first;
      continue;
    }
    GroundLine line{};
    const std::size_t end = extraction.grow(first, line);
    if (end - first >= 3) {
      lines[count++] = line;
      ground = line.height_at(line.end);
    }
    first = end - 1;  // the next line can begin at the end of this one
  }
  return count;
}

}  // namespace flagstone::baselines
