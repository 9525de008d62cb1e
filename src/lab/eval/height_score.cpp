// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/eval/height_score.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "library/core/statistics.hpp"

namespace flagstone::eval {
namespace {

/// Gathers the errors of some points.
class Errors {
 public:
  /// Of a point without a height, NaN.
  void add(double error) {
    ++points_;
    if (!std::isnan(error)) errors_.push_back(error);
  }
  [[nodiscard]] HeightErrors summary() const {
    HeightErrors summary{.points = points_, .given = errors_.size()};
    if (errors_.empty()) return summary;
    std::vector<double> absolute;
    absolute.reserve(errors_.size());
    double sum = 0;
    for (const double error : errors_) {
      sum += error;
      absolute.push_back(std::abs(error));
    }
    summary.bias = sum / static_cast<double>(errors_.size());
    summary.median = percentile(absolute, 50);
    summary.percentile95 = percentile(absolute, 95);
    return summary;
  }

 private:
  std::size_t points_ = 0;
  std::vector<double> errors_;
};

struct ErrorsByRange {
  Errors all;
  std::array<Errors, height_bands.size()> by_range;

  /// `band` is height_bands.size() beyond all bands.
  void add(std::size_t band, double error) {
    all.add(error);
    if (band < by_range.size()) by_range[band].add(error);
  }
  [[nodiscard]] HeightErrorsByRange summary() const {
    HeightErrorsByRange summary{.all = all.summary()};
    std::ranges::transform(by_range, summary.by_range.begin(), &Errors::summary);
    return summary;
  }
};

/// height_bands.size() for what lies beyond all.
std::size_t band_of(Point p) {
  const float squared_range = p.x * p.x + p.y * p.y;
  std::size_t band = 0;
  for (const float end : height_bands) band += squared_range < end * end ? 0 : 1;
  return band;
}

}  // namespace

HeightScore score_heights(CloudView cloud, std::span<const Truth> truth,
                          std::span<const float> true_ground, std::span<const float> heights) {
  ErrorsByRange ground;
  ErrorsByRange everywhere;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Point p = cloud[i];
    const double true_height = static_cast<double>(p.z) - static_cast<double>(true_ground[i]);
    if (!std::isfinite(true_height)) continue;
    const double error = static_cast<double>(heights[i]) - true_height;
    const std::size_t band = band_of(p);
    everywhere.add(band, error);
    if (truth[i] == Truth::ground) ground.add(band, error);
  }
  return {.ground = ground.summary(), .everywhere = everywhere.summary()};
}

}  // namespace flagstone::eval
