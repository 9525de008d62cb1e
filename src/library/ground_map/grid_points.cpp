// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "library/ground_map/grid_points.hpp"

#include <algorithm>
#include <array>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "library/ground_map/grid_points.cpp"
#include <hwy/foreach_target.h>
// The above includes this file once for each instruction set.
#include "library/core/simd/read_cloud-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace flagstone::HWY_NAMESPACE {
namespace {

HWY_INLINE FloatVector number(float value) { return hn::Set(FloatTag(), value); }

/// WorldGrid in the precision of points.
struct FloatGrid {
  explicit FloatGrid(const WorldGrid& grid) noexcept
      : to_sensor{static_cast<float>(grid.to_sensor[0]), static_cast<float>(grid.to_sensor[1])},
        per_metre(static_cast<float>(grid.per_metre)),
        width(static_cast<float>(grid.width)),
        down(grid.on_ground ? 1.0F : 0.0F) {
    const auto& r = grid.rotation;
    for (std::size_t k = 0; k < 3; ++k) {
      along_x[k] = static_cast<float>(r[k]);
      along_y[k] = static_cast<float>(r[k + 3]);
      const double up = r[k + 6] - grid.slope_x * r[k] - grid.slope_y * r[k + 3];
      along_up[k] = static_cast<float>(up * grid.per_metre_up);
    }
    level_of_sensor = static_cast<float>(grid.to_sensor[2] * grid.per_metre_up);
  }

  std::array<float, 3> along_x{}, along_y{}, along_up{};  // the last one in levels
  std::array<float, 2> to_sensor;
  float level_of_sensor = 0;
  float per_metre, width, down;
};

/// Finds the positions of one vector of points.
class Finder {
 public:
  /// `labels` and `heights` are those of point `first` of the scan.
  HWY_INLINE Finder(const PointFilter& filter, const WorldGrid& grid, const Label* labels,
                    const float* heights, std::size_t first, GridPoints& points)
      : filter_(filter),
        other_label_(static_cast<int>(filter.nonground ? Label::nonground : Label::ground)),
        grid_(grid),
        labels_(reinterpret_cast<const std::uint8_t*>(labels)),
        heights_(heights),
        first_(first),
        points_(points) {}

  HWY_INLINE void operator()(std::size_t i, FloatVector x, FloatVector y, FloatVector z) const {
    const FloatTag d;
    const IntTag di;
    const FloatVector height = hn::LoadU(d, heights_ + i);
    const auto passing = passes(i, x, y, height);
    if (hn::AllFalse(d, passing)) return;  // common: neighbouring points have the same label
    const FloatVector low = hn::Sub(z, hn::Mul(number(grid_.down), height));
    const auto along = [&](const std::array<float, 3>& r) HWY_ATTR {
      return hn::Add(hn::Add(hn::Mul(number(r[0]), x), hn::Mul(number(r[1]), y)),
                     hn::Mul(number(r[2]), low));
    };
    const auto index = [&](std::size_t axis, const std::array<float, 3>& r) HWY_ATTR {
      return hn::Mul(hn::Add(number(grid_.to_sensor[axis]), along(r)), number(grid_.per_metre));
    };
    const FloatVector column = index(0, grid_.along_x);
    const FloatVector row = index(1, grid_.along_y);
    const FloatVector level =
        hn::Floor(hn::Add(along(grid_.along_up), number(grid_.level_of_sensor)));
    const auto is_in = [&](FloatVector v) HWY_ATTR {
      return hn::And(hn::Ge(v, number(0)), hn::Lt(v, number(grid_.width)));
    };
    constexpr float max_level = 1 << 30;
    const auto inside =
        hn::And(hn::And(is_in(column), is_in(row)), hn::Lt(hn::Abs(level), number(max_level)));
    const auto used = hn::RebindMask(di, hn::And(passing, inside));
    const auto store = [&](IntVector v, GridPoints::Numbers& to)
                           HWY_ATTR { return compress_store(v, used, to.data() + points_.count); };
    store(whole_part(column), points_.column);
    store(whole_part(row), points_.row);
    store(hn::ConvertTo(di, level), points_.level);
    // From a constant: hn::Iota is slow for other numbers.
    const IntVector first = hn::Set(di, static_cast<std::int32_t>(first_ + i));
    points_.count += store(hn::Add(hn::Iota(di, 0), first), points_.point);
  }

 private:
  HWY_INLINE hn::Mask<FloatTag> passes(std::size_t i, FloatVector x, FloatVector y,
                                       FloatVector height) const {
    const FloatTag d;
    const IntTag di;
    const hn::Rebind<std::uint8_t, FloatTag> d8;
    const IntVector label = hn::PromoteTo(di, hn::LoadU(d8, labels_ + i));
    const auto wanted = hn::Or(hn::Eq(label, hn::Set(di, static_cast<int>(Label::ground))),
                               hn::Eq(label, hn::Set(di, other_label_)));
    const FloatVector squared = hn::Add(hn::Mul(x, x), hn::Mul(y, y));
    const auto near = hn::And(hn::And(hn::Gt(height, number(filter_.min_height)),
                                      hn::Lt(height, number(filter_.max_height))),
                              hn::Lt(squared, number(filter_.reach * filter_.reach)));
    return hn::And(near, hn::RebindMask(d, wanted));
  }

  PointFilter filter_;
  int other_label_;
  FloatGrid grid_;
  const std::uint8_t* labels_;
  const float* heights_;
  std::size_t first_;
  GridPoints& points_;
};

void find_points(const LabelledScan& scan, const PointFilter& filter, const WorldGrid& grid,
                 std::size_t begin, GridPoints& points) {
  const std::size_t end = std::min(scan.cloud.size(), begin + GridPoints::capacity);
  const std::size_t whole = begin + (end - begin) / lanes * lanes;
  points.count = 0;
  if (whole > begin) {
    read_cloud(scan.cloud, begin, whole,
               Finder(filter, grid, scan.labels.data() + begin, scan.heights.data() + begin, begin,
                      points));
  }
  if (whole < end) {
    // The last points of the cloud, with labels and heights for whole vectors.
    std::array<Label, lanes> last_labels{};
    std::array<float, lanes> last_heights{};
    last_labels.fill(Label::invalid);
    std::copy(scan.labels.data() + whole, scan.labels.data() + end, last_labels.begin());
    std::copy(scan.heights.data() + whole, scan.heights.data() + end, last_heights.begin());
    read_cloud(scan.cloud, whole, end,
               Finder(filter, grid, last_labels.data(), last_heights.data(), whole, points));
  }
}

}  // namespace
}  // namespace flagstone::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace flagstone {
namespace {
HWY_EXPORT(find_points);
}

void find_in_grid(const LabelledScan& scan, const PointFilter& filter, const WorldGrid& grid,
                  std::size_t begin, GridPoints& points) noexcept {
  HWY_DYNAMIC_DISPATCH(find_points)(scan, filter, grid, begin, points);
}

}  // namespace flagstone
#endif
