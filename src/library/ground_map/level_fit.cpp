// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "library/ground_map/level_fit.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace flagstone {
namespace {

constexpr std::size_t min_cells = 100;
constexpr int rounds = 5;
constexpr double ridge = 100;        // m^2: pulls the slopes to 0 if the cells are close together
constexpr double min_scale = 0.02;   // metres
constexpr double max_slope = 0.176;  // tangent of 10 degrees

struct Plane3 {
  double offset = 0, slope_x = 0, slope_y = 0;

  [[nodiscard]] double residual(const HeightDifference& cell) const noexcept {
    return cell.difference - offset - slope_x * cell.dx - slope_y * cell.dy;
  }
};

// 1.48 times the median of the absolute residuals: the standard deviation, for a normal
// distribution.
double scale_of(std::span<const HeightDifference> cells, const Plane3& plane,
                std::vector<double>& memory) {
  memory.clear();
  for (const HeightDifference& cell : cells) memory.push_back(std::abs(plane.residual(cell)));
  const auto middle = memory.begin() + static_cast<std::ptrdiff_t>(memory.size() / 2);
  std::ranges::nth_element(memory, middle);
  return std::max(min_scale, 1.48 * *middle);
}

// The weighted normal equations, solved by elimination. The ridge makes them regular.
template <class Weight>
Plane3 weighted_fit(std::span<const HeightDifference> cells, const Weight& weight) {
  double w = 0, x = 0, y = 0, xx = 0, xy = 0, yy = 0, d = 0, xd = 0, yd = 0;
  for (const HeightDifference& cell : cells) {
    const double each = weight(cell);
    w += each;
    x += each * cell.dx;
    y += each * cell.dy;
    d += each * cell.difference;
    xx += each * cell.dx * cell.dx;
    xy += each * cell.dx * cell.dy;
    yy += each * cell.dy * cell.dy;
    xd += each * cell.dx * cell.difference;
    yd += each * cell.dy * cell.difference;
  }
  // Relative to the weighted mean, the offset separates from the slopes.
  const double sxx = xx - x * x / w + ridge;
  const double syy = yy - y * y / w + ridge;
  const double sxy = xy - x * y / w;
  const double sxd = xd - x * d / w;
  const double syd = yd - y * d / w;
  const double determinant = sxx * syy - sxy * sxy;
  Plane3 plane;
  plane.slope_x = (sxd * syy - syd * sxy) / determinant;
  plane.slope_y = (syd * sxx - sxd * sxy) / determinant;
  plane.offset = (d - plane.slope_x * x - plane.slope_y * y) / w;
  return plane;
}

}  // namespace

Levelling fit_level(std::span<const HeightDifference> differences, const Levelling& expected,
                    double max_correction, std::vector<double>& memory) {
  Levelling levelling = expected;
  levelling.applied = false;
  levelling.cells = differences.size();
  if (differences.size() < min_cells) return levelling;
  Plane3 plane;
  // The first plane is the median difference: a scan of which half contradicts the map still fits.
  memory.clear();
  for (const HeightDifference& cell : differences) memory.push_back(cell.difference);
  const auto middle = memory.begin() + static_cast<std::ptrdiff_t>(memory.size() / 2);
  std::ranges::nth_element(memory, middle);
  plane.offset = *middle;
  for (int round = 0; round < rounds; ++round) {
    const double scale = scale_of(differences, plane, memory);
    plane = weighted_fit(differences, [&](const HeightDifference& cell) {
      const double relative = plane.residual(cell) / (2 * scale);
      const double root = 1 + relative * relative;
      return 1 / (root * root);
    });
  }
  if (!(std::abs(plane.offset - expected.offset) <= max_correction) ||
      !(std::hypot(plane.slope_x - expected.slope_x, plane.slope_y - expected.slope_y) <=
        max_slope)) {
    return levelling;
  }
  levelling.applied = true;
  levelling.offset = plane.offset;
  levelling.slope_x = plane.slope_x;
  levelling.slope_y = plane.slope_y;
  return levelling;
}

}  // namespace flagstone
