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

using HalfFloatTag = hn::Rebind<float, DoubleTag>;
using HalfIntTag = hn::Rebind<std::int32_t, DoubleTag>;

HWY_INLINE DoubleVector number(double value) { return hn::Set(DoubleTag(), value); }

/// Stores the integer part of numbers from 0 to `limit`, which is at most 2^31, and -1 for other
/// numbers and NaN.
HWY_INLINE void store_whole(DoubleVector v, double limit, std::int32_t* to) {
  const auto inside = hn::And(hn::Ge(v, number(0)), hn::Lt(v, number(limit)));
  hn::StoreU(hn::DemoteTo(HalfIntTag(), hn::IfThenElse(inside, v, number(-1))), HalfIntTag(), to);
}

/// Finds the positions of one vector of points.
class Finder {
 public:
  /// `labels` and `heights` are those of point `first` of `points`.
  HWY_INLINE Finder(const PointFilter& filter, const WorldGrid& grid, const std::uint8_t* labels,
                    const float* heights, std::size_t first, GridPoints& points)
      : filter_(filter),
        other_label_(static_cast<int>(filter.nonground ? Label::nonground : Label::ground)),
        grid_(grid),
        down_(grid.on_ground ? 1 : 0),
        labels_(labels),
        heights_(heights),
        first_(first),
        points_(points) {}

  HWY_INLINE void operator()(std::size_t i, FloatVector x, FloatVector y, FloatVector z) const {
    const FloatTag d;
    const FloatVector height = hn::LoadU(d, heights_ + i);
    // A point without a position is outside.
    const FloatVector none = hn::NaN(d);
    alignas(64) std::array<float, 4 * lanes> numbers;
    hn::Store(hn::IfThenElse(passes(i, x, y, height), x, none), d, numbers.data());
    hn::Store(y, d, numbers.data() + lanes);
    hn::Store(z, d, numbers.data() + 2 * lanes);
    hn::Store(height, d, numbers.data() + 3 * lanes);
    for (std::size_t k = 0; k < hn::Lanes(d); k += hn::Lanes(DoubleTag())) {
      place(numbers.data() + k, first_ + i + k);
    }
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
    const auto near = hn::And(hn::And(hn::Gt(height, hn::Set(d, filter_.min_height)),
                                      hn::Lt(height, hn::Set(d, filter_.max_height))),
                              hn::Lt(squared, hn::Set(d, filter_.reach * filter_.reach)));
    return hn::And(near, hn::RebindMask(d, wanted));
  }

  // x, y, z and height of half a vector of points, `lanes` apart.
  HWY_INLINE void place(const float* numbers, std::size_t to) const {
    const auto load = [&](std::size_t k) HWY_ATTR {
      return hn::PromoteTo(DoubleTag(), hn::LoadU(HalfFloatTag(), numbers + k * lanes));
    };
    const DoubleVector x = load(0);
    const DoubleVector y = load(1);
    const DoubleVector z = hn::Sub(load(2), hn::Mul(number(down_), load(3)));
    const auto along = [&](std::size_t row) HWY_ATTR {
      const auto& r = grid_.rotation;
      return hn::Add(hn::Add(hn::Mul(number(r[row]), x), hn::Mul(number(r[row + 1]), y)),
                     hn::Mul(number(r[row + 2]), z));
    };
    const DoubleVector dx = along(0);
    const DoubleVector dy = along(3);
    const DoubleVector dz = along(6);
    const DoubleVector per_metre = number(grid_.per_metre);
    const DoubleVector slope =
        hn::Add(hn::Mul(number(grid_.slope_x), dx), hn::Mul(number(grid_.slope_y), dy));
    const DoubleVector up = hn::Sub(hn::Add(number(grid_.to_sensor[2]), dz), slope);
    constexpr double base = GridPoints::base_level;
    store_whole(hn::Mul(hn::Add(number(grid_.to_sensor[0]), dx), per_metre), grid_.width,
                points_.column.data() + to);
    store_whole(hn::Mul(hn::Add(number(grid_.to_sensor[1]), dy), per_metre), grid_.width,
                points_.row.data() + to);
    store_whole(hn::Add(hn::Mul(up, number(grid_.per_metre_up)), number(base)), 2 * base,
                points_.level.data() + to);
  }

  PointFilter filter_;
  int other_label_;
  WorldGrid grid_;
  double down_;
  const std::uint8_t* labels_;
  const float* heights_;
  std::size_t first_;
  GridPoints& points_;
};

void find_points(const CloudView& cloud, const Segmentation& result, const PointFilter& filter,
                 const WorldGrid& grid, std::size_t begin, GridPoints& points) {
  const std::size_t end = std::min(cloud.size(), begin + GridPoints::capacity);
  const std::size_t whole = begin + (end - begin) / lanes * lanes;
  const auto* const labels = reinterpret_cast<const std::uint8_t*>(result.labels().data());
  const float* const heights = result.heights().data();
  if (whole > begin) {
    read_cloud(cloud, begin, whole,
               Finder(filter, grid, labels + begin, heights + begin, 0, points));
  }
  if (whole < end) {
    // The last points of the cloud, with labels and heights for whole vectors.
    std::array<std::uint8_t, lanes> last_labels{};
    std::array<float, lanes> last_heights{};
    std::copy(labels + whole, labels + end, last_labels.begin());
    std::copy(heights + whole, heights + end, last_heights.begin());
    read_cloud(
        cloud, whole, end,
        Finder(filter, grid, last_labels.data(), last_heights.data(), whole - begin, points));
  }
  points.count = end - begin;
}

}  // namespace
}  // namespace flagstone::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace flagstone {
namespace {
HWY_EXPORT(find_points);
}

void find_in_grid(const CloudView& cloud, const Segmentation& result, const PointFilter& filter,
                  const WorldGrid& grid, std::size_t begin, GridPoints& points) noexcept {
  HWY_DYNAMIC_DISPATCH(find_points)(cloud, result, filter, grid, begin, points);
}

}  // namespace flagstone
#endif
