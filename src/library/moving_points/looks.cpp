// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "library/moving_points/looks.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

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

// A range with its margin for errors of poses and measurements, in units of RangeImage::unit.
struct RangeInterval {
  int low, high;

  explicit RangeInterval(float range) noexcept {
    constexpr float units_per_metre = 1 / RangeImage::unit;
    const float margin = 0.4F + 0.01F * range;  // metres
    low = static_cast<int>((range - margin) * units_per_metre);
    high = static_cast<int>((range + margin) * units_per_metre);
  }
  [[nodiscard]] bool contains(std::uint16_t measured) const noexcept {
    return measured > low && measured <= high;
  }
};

bool has_object(const RangePixel& pixel, const RangeInterval& range) noexcept {
  return pixel.farthest_object != 0 &&
         (range.contains(pixel.nearest_object) || range.contains(pixel.farthest_object));
}

bool is_occupied(const RangePixel* pixel, const RangeInterval& range) noexcept {
  constexpr std::ptrdiff_t up = RangeImage::stride;
  for (const std::ptrdiff_t row : {std::ptrdiff_t{0}, up, -up}) {
    for (const std::ptrdiff_t column : {0, 1, -1}) {
      if (has_object(pixel[row + column], range)) return true;
    }
  }
  return false;
}

// The ray of the pixel passes the point closely and ends behind it, and no edge of an object is
// next to it.
bool is_seen_through(const RangePixel* pixel, const RangeInterval& range, float metres,
                     float elevation) noexcept {
  constexpr float max_distance_of_ray = 0.3F;  // metres
  if (pixel->nearest == RangePixel::nothing || pixel->nearest <= range.high) return false;
  const float measured = static_cast<float>(pixel->elevation) * RangeImage::elevation_unit;
  if (!(metres * std::abs(measured - elevation) < max_distance_of_ray)) return false;
  return pixel[-1].nearest_object > range.low && pixel[1].nearest_object > range.low;
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

void add_looks(const RangeImage& image, const Directions& directions,
               std::vector<LookCounts>& counts) noexcept {
  constexpr float min_range = 0.5F;   // metres; nearer, directions are not reliable
  constexpr float max_range = 200.F;  // metres
  for (std::size_t k = 0; k < counts.size(); ++k) {
    const float metres = directions.range(k);
    if (!(metres > min_range) || !(metres < max_range)) continue;
    const RangePixel* const pixel = image.pixel(directions.row(k), directions.column(k));
    const RangeInterval range(metres);
    if (is_occupied(pixel, range)) {
      ++counts[k].occupied;
    } else if (is_seen_through(pixel, range, metres, directions.elevation(k))) {
      ++counts[k].through;
    }
  }
}

}  // namespace flagstone
