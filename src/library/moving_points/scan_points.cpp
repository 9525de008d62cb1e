// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "library/moving_points/scan_points.hpp"

#include <algorithm>
#include <array>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "library/moving_points/scan_points.cpp"
#include <hwy/foreach_target.h>
// foreach_target.h includes this file once per instruction set.
#include "library/core/simd/read_cloud-inl.hpp"

#ifndef FLAGSTONE_MOVING_POINTS_SCAN_POINTS_ONCE
#define FLAGSTONE_MOVING_POINTS_SCAN_POINTS_ONCE
namespace flagstone {

/// The arrays of ScanPoints.
struct ScanPointArrays {
  float* x;
  float* y;
  float* z;
  std::uint8_t* is_object;
  std::uint32_t* in_columns;
  std::uint32_t* candidates;
  std::uint32_t* candidate_columns;
  std::uint32_t* candidate_surroundings;
  std::uint32_t* candidate_hashes;
};

}  // namespace flagstone
#endif

HWY_BEFORE_NAMESPACE();
namespace flagstone::HWY_NAMESPACE {
namespace {

/// Reads one vector of points.
class PointReader {
 public:
  /// `labels` and `heights` are those of point `first`.
  HWY_INLINE PointReader(const ScanPointsRule& rule, const Label* labels, const float* heights,
                         std::size_t first, const ScanPointArrays& to, std::size_t& candidates)
      : rule_(rule),
        labels_(reinterpret_cast<const std::uint8_t*>(labels)),
        heights_(heights),
        first_(first),
        to_(to),
        candidates_(candidates) {}

  HWY_INLINE void operator()(std::size_t i, FloatVector x, FloatVector y, FloatVector z) const {
    const FloatTag d;
    const IntTag di;
    const hn::Rebind<std::uint8_t, FloatTag> d8;
    const IntVector label = hn::PromoteTo(di, hn::LoadU(d8, labels_ + i));
    const FloatVector height = hn::LoadU(d, heights_ + i);
    const auto has = [&](Label value) HWY_ATTR {
      return hn::RebindMask(d, hn::Eq(label, hn::Set(di, static_cast<int>(value))));
    };
    const std::size_t k = first_ + i;
    const auto unused = hn::Or(has(Label::invalid), has(Label::noise));
    hn::StoreU(hn::IfThenZeroElse(unused, x), d, to_.x + k);
    hn::StoreU(hn::IfThenZeroElse(unused, y), d, to_.y + k);
    hn::StoreU(hn::IfThenZeroElse(unused, z), d, to_.z + k);
    const auto nonground = has(Label::nonground);
    store_bits(bits_of(d, nonground), to_.is_object + k);

    const auto along = [&](std::size_t row) HWY_ATTR {
      const auto& m = rule_.to_world;
      return hn::Add(hn::Add(hn::Mul(number(m[row]), x), hn::Mul(number(m[row + 1]), y)),
                     hn::Mul(number(m[row + 2]), z));
    };
    const FloatVector dx = along(0);
    const FloatVector dy = along(3);
    const FloatVector level = hn::Add(hn::Mul(x, x), hn::Mul(y, y));
    write_in_column(k, has(Label::ground), nonground, height, level,
                    column_at(rule_.columns, dx, dy));
    const auto chosen = candidates(nonground, height, hn::Add(level, hn::Mul(z, z)));
    if (hn::AllFalse(d, chosen)) return;
    write_candidates(k, chosen, dx, dy, hash_of(x, y, z));
  }

 private:
  static HWY_INLINE FloatVector number(float value) { return hn::Set(FloatTag(), value); }

  // ColumnGrid::column_at for a vector.
  static HWY_INLINE IntVector column_at(const ColumnGrid& grid, FloatVector dx, FloatVector dy) {
    const IntTag di;
    const FloatVector column = hn::Mul(hn::Add(dx, number(grid.offset_x)), number(grid.per_metre));
    const FloatVector row = hn::Mul(hn::Add(dy, number(grid.offset_y)), number(grid.per_metre));
    const FloatVector last = number(static_cast<float>(grid.width - 1));
    const auto is_inside = [&](FloatVector index) HWY_ATTR {
      return hn::And(hn::Ge(index, number(1)), hn::Lt(index, last));
    };
    const auto inside = hn::And(is_inside(column), is_inside(row));
    const IntVector index = hn::Add(hn::Mul(hn::ConvertTo(di, hn::IfThenElseZero(inside, row)),
                                            hn::Set(di, static_cast<int>(grid.width))),
                                    hn::ConvertTo(di, hn::IfThenElseZero(inside, column)));
    return hn::IfThenElse(hn::RebindMask(di, inside), index,
                          hn::Set(di, static_cast<int>(grid.outside())));
  }

  // Higher points can be parts of bridges or trees above a road. Farther away, a scan does not see
  // all objects.
  HWY_INLINE void write_in_column(std::size_t k, hn::Mask<FloatTag> ground,
                                  hn::Mask<FloatTag> nonground, FloatVector height,
                                  FloatVector squared_range, IntVector column) const {
    constexpr float min_height = 0.25F;  // metres
    constexpr float max_height = 2.2F;   // metres
    constexpr float max_range = 40;      // metres
    const IntTag di;
    const auto object = hn::And(
        nonground, hn::And(hn::Gt(height, number(min_height)), hn::Lt(height, number(max_height))));
    const auto used =
        hn::And(hn::Or(ground, object), hn::Lt(squared_range, number(max_range * max_range)));
    const IntVector twice = hn::Add(column, column);
    const IntVector value =
        hn::Add(twice, hn::IfThenElseZero(hn::RebindMask(di, object), hn::Set(di, 1)));
    const IntVector outside = hn::Set(di, static_cast<int>(2 * rule_.columns.outside()));
    hn::StoreU(hn::IfThenElse(hn::RebindMask(di, used), value, outside), di,
               reinterpret_cast<std::int32_t*>(to_.in_columns + k));
  }

  // Points whose height is unknown could move, too.
  HWY_INLINE hn::Mask<FloatTag> candidates(hn::Mask<FloatTag> nonground, FloatVector height,
                                           FloatVector squared_range) const {
    const auto excluded =
        hn::Or(hn::Le(height, number(rule_.min_height)), hn::Gt(height, number(rule_.max_height)));
    const auto near = hn::Lt(squared_range, number(rule_.max_range * rule_.max_range));
    return hn::AndNot(excluded, hn::And(nonground, near));
  }

  // A hash of the coordinates.
  static HWY_INLINE IntVector hash_of(FloatVector x, FloatVector y, FloatVector z) {
    const hn::RebindToUnsigned<FloatTag> du;
    const auto product = [&](auto v, std::uint32_t factor)
                             HWY_ATTR { return hn::Mul(v, hn::Set(du, factor)); };
    auto hash = product(hn::BitCast(du, x), 0x9E3779B1U);
    hash = product(hn::Xor(hash, hn::BitCast(du, y)), 0x85EBCA77U);
    hash = hn::Xor(hn::Xor(hash, hn::ShiftRight<15>(hash)), hn::BitCast(du, z));
    hash = product(hash, 0xC2B2AE3DU);
    return hn::BitCast(IntTag(), hn::Xor(hash, hn::ShiftRight<16>(hash)));
  }

  HWY_INLINE void write_candidates(std::size_t k, hn::Mask<FloatTag> candidates, FloatVector dx,
                                   FloatVector dy, IntVector hash) const {
    const IntTag di;
    const IntVector column = column_at(rule_.objects, dx, dy);
    const auto outside = hn::Eq(column, hn::Set(di, static_cast<int>(rule_.objects.outside())));
    const auto chosen = hn::AndNot(outside, hn::RebindMask(di, candidates));
    const auto store = [&](IntVector v, std::uint32_t* to) HWY_ATTR {
      return compress_store(v, chosen, reinterpret_cast<std::int32_t*>(to + candidates_));
    };
    store(column, to_.candidate_columns);
    store(column_at(rule_.surroundings, dx, dy), to_.candidate_surroundings);
    store(hash, to_.candidate_hashes);
    // From a constant: hn::Iota is slow for other numbers.
    const IntVector first = hn::Set(di, static_cast<std::int32_t>(k));
    candidates_ += store(hn::Add(hn::Iota(di, 0), first), to_.candidates);
  }

  const ScanPointsRule& rule_;
  const std::uint8_t* labels_;
  const float* heights_;
  std::size_t first_;
  const ScanPointArrays& to_;
  std::size_t& candidates_;
};

std::size_t read_points(const CloudView& cloud, const Label* labels, const float* heights,
                        const ScanPointsRule& rule, const ScanPointArrays& to) {
  std::size_t candidates = 0;
  const std::size_t whole = cloud.size() / lanes * lanes;
  if (whole > 0) {
    read_cloud(cloud, 0, whole, PointReader(rule, labels, heights, 0, to, candidates));
  }
  if (whole < cloud.size()) {
    // The last points, with labels and heights for whole vectors.
    std::array<Label, lanes> last_labels{};
    std::array<float, lanes> last_heights{};
    last_labels.fill(Label::invalid);
    std::copy(labels + whole, labels + cloud.size(), last_labels.begin());
    std::copy(heights + whole, heights + cloud.size(), last_heights.begin());
    read_cloud(cloud, whole, cloud.size(),
               PointReader(rule, last_labels.data(), last_heights.data(), whole, to, candidates));
  }
  return candidates;
}

}  // namespace
}  // namespace flagstone::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace flagstone {
namespace {
HWY_EXPORT(read_points);
}  // namespace

void ScanPoints::read(CloudView cloud, std::span<const Label> labels,
                      std::span<const float> heights, const ScanPointsRule& rule) {
  points_.resize(cloud.size());
  constexpr std::size_t padding = PointArrays::padding;
  const std::size_t padded = cloud.size() + 2 * padding;  // vectors are stored as a whole
  is_object_.reserve(padded);
  for (Buffer<std::uint32_t>* array : {&in_columns_, &candidates_, &candidate_columns_,
                                       &candidate_surroundings_, &candidate_hashes_}) {
    array->reserve(padded);
  }
  outside_ = rule.columns.outside();
  candidate_count_ =
      HWY_DYNAMIC_DISPATCH(read_points)(cloud, labels.data(), heights.data(), rule,
                                        {.x = points_.x(),
                                         .y = points_.y(),
                                         .z = points_.z(),
                                         .is_object = is_object_.data(),
                                         .in_columns = in_columns_.data(),
                                         .candidates = candidates_.data(),
                                         .candidate_columns = candidate_columns_.data(),
                                         .candidate_surroundings = candidate_surroundings_.data(),
                                         .candidate_hashes = candidate_hashes_.data()});
}

}  // namespace flagstone
#endif
