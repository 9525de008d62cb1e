// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/sim/ground_plan.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace flagstone::sim {

void add_lines(std::vector<double>& lines, double begin, double end, double step) {
  const int count = std::max(1, static_cast<int>(std::ceil((end - begin) / step - 1e-9)));
  for (int i = 0; i <= count; ++i) lines.push_back(begin + (end - begin) * i / count);
}

void finish_lines(std::vector<double>& lines) {
  constexpr double same = 1e-6;
  std::ranges::sort(lines);
  const auto repeated = std::ranges::unique(lines, [](double a, double b) { return b - a < same; });
  lines.erase(repeated.begin(), repeated.end());
}

Ground cut_ground(GroundPlan plan) {
  GroundGrid grid{.x = std::move(plan.x), .offset = {}, .t = std::move(plan.t)};
  std::vector<double> heights;
  std::vector<Surface> surfaces;
  heights.reserve(grid.x.size() * grid.t.size());
  surfaces.reserve(grid.x.size() * grid.t.size());
  for (std::size_t i = 0; i < grid.x.size(); ++i) {
    grid.offset.push_back(plan.offset(grid.x[i]));
    for (const double t : grid.t) heights.push_back(plan.height(grid.x[i], t));
    if (i + 1 == grid.x.size()) break;
    const double middle_x = (grid.x[i] + grid.x[i + 1]) / 2;
    for (std::size_t j = 0; j + 1 < grid.t.size(); ++j) {
      surfaces.push_back(plan.surface(middle_x, (grid.t[j] + grid.t[j + 1]) / 2));
    }
  }
  return {std::move(grid), std::move(heights), std::move(surfaces)};
}

}  // namespace flagstone::sim
