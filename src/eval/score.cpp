// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "eval/score.hpp"

#include <algorithm>
#include <cmath>

namespace flagstone::eval {
namespace {

constexpr int half_cells = static_cast<int>(range_bands.back() / cell_size);
constexpr std::uint32_t row_cells = 2 * half_cells;
constexpr std::uint32_t no_cell = row_cells * row_cells;

/// False for what is not finite, too.
bool is_covered(float coordinate) { return std::abs(coordinate) < range_bands.back(); }

std::uint32_t cell_of(Point p) {
  if (!is_covered(p.x) || !is_covered(p.y)) return no_cell;
  const auto index = [](float coordinate) {
    return static_cast<std::uint32_t>(static_cast<int>(std::floor(coordinate / cell_size)) +
                                      half_cells);
  };
  return index(p.x) * row_cells + index(p.y);
}

std::uint8_t band_of(Point p) {
  const float squared_range = p.x * p.x + p.y * p.y;
  std::uint8_t band = 0;
  // A comparison with NaN is false.
  while (band < range_bands.size() && !(squared_range < range_bands[band] * range_bands[band])) {
    ++band;
  }
  return band;
}

}  // namespace

void ScanTruth::set(const Protocol& protocol, CloudView cloud,
                    std::span<const std::uint32_t> classes) {
  truth_of(protocol, cloud, classes, truth_);
  bands_.resize(cloud.size());
  cells_.resize(cloud.size());
  cell_points_.assign(no_cell + 1, 0);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Point p = cloud[i];
    bands_[i] = band_of(p);
    cells_[i] = cell_of(p);
    cell_points_[cells_[i]] += truth_[i] != Truth::ignored;
  }
  weights_.resize(cloud.size());
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const bool counts = cells_[i] != no_cell && truth_[i] != Truth::ignored;
    weights_[i] = counts ? 1 / static_cast<float>(cell_points_[cells_[i]]) : 0;
  }
}

Score ScanTruth::score(std::span<const Label> labels) const noexcept {
  enum : std::size_t { true_negative, false_positive, false_negative, true_positive, ignored };
  std::array<std::array<std::uint64_t, 5>, range_bands.size() + 1> points{};
  std::array<double, 5> area{};
  for (std::size_t i = 0; i < labels.size(); ++i) {
    const bool found = labels[i] == Label::ground;
    const bool is = truth_[i] == Truth::ground;
    const std::size_t outcome =
        truth_[i] == Truth::ignored ? ignored : 2 * std::size_t{is} + std::size_t{found};
    ++points[bands_[i]][outcome];
    area[outcome] += static_cast<double>(weights_[i]);
  }

  const auto confusion = [](const auto& counts) {
    return Confusion{.true_positives = static_cast<double>(counts[true_positive]),
                     .false_positives = static_cast<double>(counts[false_positive]),
                     .false_negatives = static_cast<double>(counts[false_negative]),
                     .true_negatives = static_cast<double>(counts[true_negative])};
  };
  Score score;
  for (std::size_t band = 0; band < points.size(); ++band) {
    const Confusion in_band = confusion(points[band]);
    score.points += in_band;
    if (band < score.by_range.size()) score.by_range[band] = in_band;
  }
  score.by_area = confusion(area);
  return score;
}

}  // namespace flagstone::eval
