// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/eval/score.hpp"

namespace flagstone::eval {
namespace {

constexpr auto row_cells = static_cast<std::uint32_t>(2 * range_bands.back() / cell_size);
constexpr std::uint32_t no_cell = row_cells * row_cells;

/// Points are counted in groups: twice the band (one more for what lies beyond), plus one for true
/// ground; and those that are not scored.
constexpr std::size_t not_scored = 2 * (range_bands.size() + 1);

std::uint32_t cell_of(Point p) {
  constexpr float half_side = range_bands.back();
  const float x = p.x + half_side;
  const float y = p.y + half_side;
  const auto is_covered = [](float v) { return v >= 0 && v < 2 * half_side; };  // not if NaN
  if (!is_covered(x) || !is_covered(y)) return no_cell;
  return static_cast<std::uint32_t>(x / cell_size) * row_cells +
         static_cast<std::uint32_t>(y / cell_size);
}

/// Branches would often be mispredicted. What is not finite lies beyond all bands.
std::uint32_t band_of(Point p) {
  const float squared_range = p.x * p.x + p.y * p.y;
  std::uint32_t band = 0;
  for (const float end : range_bands) band += squared_range < end * end ? 0 : 1;
  return band;
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
    const std::uint32_t group = 2 * band_of(p) + (truth_[i] == Truth::ground ? 1 : 0);
    groups_[i] = static_cast<std::uint8_t>(is_scored ? group : not_scored);
    cells_[i] = is_scored ? cell_of(p) : no_cell;
    ++cell_points_[cells_[i]];
  }
  shares_.resize(cell_points_.size());
  for (std::size_t c = 0; c < no_cell; ++c) shares_[c] = 1 / static_cast<float>(cell_points_[c]);
  shares_[no_cell] = 0;
}

Score ScanTruth::score(std::span<const Label> labels) const noexcept {
  std::array<std::array<std::uint64_t, 2>, not_scored + 1> points{};  // by group and found
  std::array<std::array<double, 2>, 2> area{};                        // by truth and found
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

}  // namespace flagstone::eval
