// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/eval/score.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "library/core/statistics.hpp"

namespace flagstone::eval {
Confusion& Confusion::operator+=(const Confusion& other) noexcept {
  true_positives += other.true_positives;
  false_positives += other.false_positives;
  false_negatives += other.false_negatives;
  true_negatives += other.true_negatives;
  return *this;
}

std::string percent_text(double ratio) {
  return std::isnan(ratio) ? "n/a" : fmt::format("{:.2f}", 100 * ratio);
}

std::string scores_text(const Confusion& confusion) {
  if (!confusion.has_ground()) {
    return fmt::format("no ground in the ground truth, accuracy {} %",
                       percent_text(confusion.accuracy()));
  }
  return fmt::format("precision {} %, recall {} %, F1 {} %", percent_text(confusion.precision()),
                     percent_text(confusion.recall()), percent_text(confusion.f1()));
}

Confusion compare(std::span<const Label> labels, std::span<const Truth> truth) {
  Confusion confusion;
  for (std::size_t i = 0; i < labels.size(); ++i) {
    if (truth[i] == Truth::ignored) continue;
    const bool found = labels[i] == Label::ground;
    const bool is = truth[i] == Truth::ground;
    confusion.true_positives += found && is;
    confusion.false_positives += found && !is;
    confusion.false_negatives += !found && is;
    confusion.true_negatives += !found && !is;
  }
  return confusion;
}

namespace {

constexpr auto row_cells = static_cast<std::uint32_t>(2 * range_bands.back() / cell_size);
constexpr std::uint32_t no_cell = row_cells * row_cells;

/// Points are counted in groups. The group is 2 * band, plus 1 for ground in the ground truth;
/// there is one more band beyond the last, and one group for points that are not scored.
constexpr std::size_t not_scored = 2 * (range_bands.size() + 1);

std::uint32_t cell_of(Point p) {
  constexpr float half_side = range_bands.back();
  const auto is_covered = [](float v) { return v >= -half_side && v < half_side; };  // not NaN
  if (!is_covered(p.x) || !is_covered(p.y)) return no_cell;
  // Exact, so that points next to the edge of a cell are not moved across it.
  const auto index = [](float v) {
    return static_cast<std::uint32_t>(std::floor(v / cell_size) + half_side / cell_size);
  };
  return index(p.x) * row_cells + index(p.y);
}

}  // namespace

void ScanTruth::set(const Protocol& protocol, CloudView cloud,
                    std::span<const std::uint32_t> classes) {
  truth_of(protocol, cloud, classes, truth_);
  groups_.resize(cloud.size());
  cells_.resize(cloud.size());
  cell_points_.assign(no_cell + 1, 0);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Point p = cloud[i];
    const bool is_scored = truth_[i] != Truth::ignored;
    const std::uint32_t group = 2 * band_of(p, range_bands) + (truth_[i] == Truth::ground ? 1 : 0);
    groups_[i] = static_cast<std::uint8_t>(is_scored ? group : not_scored);
    cells_[i] = is_scored ? cell_of(p) : no_cell;
    ++cell_points_[cells_[i]];
  }
  shares_.resize(cell_points_.size());
  for (std::size_t c = 0; c < no_cell; ++c) shares_[c] = 1 / static_cast<float>(cell_points_[c]);
  shares_[no_cell] = 0;
}

Score ScanTruth::score(std::span<const Label> labels) const noexcept {
  std::array<std::array<std::uint64_t, 2>, not_scored + 1>
      points{};                                 // by group, and labelled ground or not
  std::array<std::array<double, 2>, 2> area{};  // by ground truth, and labelled ground or not
  for (std::size_t i = 0; i < labels.size(); ++i) {
    const std::size_t found = labels[i] == Label::ground ? 1 : 0;
    ++points[groups_[i]][found];
    area[groups_[i] % 2][found] += static_cast<double>(shares_[cells_[i]]);
  }

  const auto confusion = [](const auto& not_ground, const auto& ground) {
    return Confusion{.true_positives = static_cast<double>(ground[1]),
                     .false_positives = static_cast<double>(not_ground[1]),
                     .false_negatives = static_cast<double>(ground[0]),
                     .true_negatives = static_cast<double>(not_ground[0])};
  };
  Score score;
  for (std::size_t band = 0; band <= score.by_range.size(); ++band) {
    const Confusion in_band = confusion(points[2 * band], points[2 * band + 1]);
    score.points += in_band;
    if (band < score.by_range.size()) score.by_range[band] = in_band;
  }
  score.by_area = confusion(area[0], area[1]);
  return score;
}

namespace {

/// Collects the errors of a set of points.
class Errors {
 public:
  /// `error` is NaN for a point without a height.
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

  /// `band` is height_bands.size() beyond the last band.
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

/// Height errors over ground points and over all points.
struct PairOfErrors {
  HeightErrorsByRange ground, everywhere;
};

/// Errors of heights at the points with a known true height that `is_included` selects by index.
template <class IsIncluded>
PairOfErrors errors_of(CloudView cloud, std::span<const Truth> truth,
                       std::span<const float> true_ground, std::span<const float> heights,
                       IsIncluded is_included) {
  ErrorsByRange ground;
  ErrorsByRange everywhere;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Point p = cloud[i];
    const double true_height = static_cast<double>(p.z) - static_cast<double>(true_ground[i]);
    if (!std::isfinite(true_height) || !is_included(i)) continue;
    const double error = static_cast<double>(heights[i]) - true_height;
    const std::size_t band = band_of(p, height_bands);
    everywhere.add(band, error);
    if (truth[i] == Truth::ground) ground.add(band, error);
  }
  return {.ground = ground.summary(), .everywhere = everywhere.summary()};
}

}  // namespace

HeightScore score_heights(CloudView cloud, std::span<const Truth> truth,
                          std::span<const float> true_ground, std::span<const float> heights) {
  const PairOfErrors errors =
      errors_of(cloud, truth, true_ground, heights, [](std::size_t) { return true; });
  return {.ground = errors.ground,
          .everywhere = errors.everywhere,
          .common_ground = {},
          .common_everywhere = {}};
}

void score_common_heights(CloudView cloud, std::span<const Truth> truth,
                          std::span<const float> true_ground,
                          std::span<const std::vector<float>> heights,
                          std::span<HeightScore* const> scores) {
  const auto have_all = [&](std::size_t i) {
    return std::ranges::none_of(heights, [i](const auto& own) { return std::isnan(own[i]); });
  };
  for (std::size_t m = 0; m < scores.size(); ++m) {
    const PairOfErrors errors = errors_of(cloud, truth, true_ground, heights[m], have_all);
    scores[m]->has_common = true;
    scores[m]->common_ground = errors.ground;
    scores[m]->common_everywhere = errors.everywhere;
  }
}

}  // namespace flagstone::eval
