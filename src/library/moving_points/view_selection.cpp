// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "library/moving_points/looks.hpp"

namespace flagstone {
namespace {

constexpr std::array intervals{0.3, 0.5, 0.8, 1.0, 1.2, 1.5, 1.8, 2.0, 2.5,
                               3.0, 3.5, 4.0, 4.5, 5.0, 6.0, 7.0, 8.0};  // seconds

// The scan nearest to `target`, on the side of `time` of the target, or null. Of two scans that are
// equally near, the earlier one, even if their times are rounded.
const ScanView* nearest_view(const std::deque<ScanView>& scans, double time, double target) {
  const ScanView* nearest = nullptr;
  for (const ScanView& scan : scans) {
    const bool same_side = target < time ? scan.time < time : scan.time > time;
    if (!same_side) continue;
    constexpr double rounding = 1e-4;  // seconds
    if (nearest == nullptr ||
        std::abs(scan.time - target) < std::abs(nearest->time - target) - rounding) {
      nearest = &scan;
    }
  }
  return nearest;
}

void select_views(const std::deque<ScanView>& scans, double time, double scale,
                  std::vector<const ScanView*>& selected) {
  selected.clear();
  for (const double side : {-1.0, 1.0}) {
    for (const double interval : intervals) {
      const double target = time + side * interval * scale;
      const ScanView* const view = nearest_view(scans, time, target);
      if (view == nullptr) continue;
      const double tolerance = 0.25 * interval * scale + 0.06;  // seconds
      const bool is_new = std::ranges::find(selected, view) == selected.end();
      if (is_new && std::abs(view->time - target) <= tolerance) selected.push_back(view);
    }
  }
}

}  // namespace

void select_views(const std::deque<ScanView>& scans, double time,
                  std::vector<const ScanView*>& selected) {
  constexpr std::size_t min_views = 8;
  constexpr double min_scale = 0.05;
  select_views(scans, time, 1, selected);
  if (selected.size() >= min_views || scans.empty()) return;
  const double covered =
      std::max(std::abs(scans.front().time - time), std::abs(scans.back().time - time));
  select_views(scans, time, std::clamp(covered / intervals.back(), min_scale, 1.0), selected);
}

}  // namespace flagstone
