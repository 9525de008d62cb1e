// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "library/moving_points/range_image.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "library/moving_points/range_image.cpp"
#include <hwy/foreach_target.h>
// foreach_target.h includes this file once per instruction set.
#include "library/moving_points/pixel_places-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace flagstone::HWY_NAMESPACE {
namespace {

HWY_INLINE hn::Mask<FloatTag> is_used(FloatVector range) {
  const FloatTag d;
  return hn::And(hn::Gt(range, hn::Zero(d)), hn::Lt(range, hn::Set(d, RangeImage::max_range)));
}

ImageRows find_rows(const Directions& directions, std::size_t count) {
  const FloatTag d;
  const IntTag di;
  constexpr int highest_int = std::numeric_limits<int>::max();
  constexpr int lowest_int = std::numeric_limits<int>::min();
  IntVector lowest = hn::Set(di, highest_int);
  IntVector highest = hn::Set(di, lowest_int);
  for (std::size_t k = 0; k < count; k += hn::Lanes(d)) {
    const auto used = hn::RebindMask(
        di, hn::And(is_used(hn::Load(d, directions.ranges() + k)), hn::FirstN(d, count - k)));
    const IntVector row = hn::Load(di, directions.rows() + k);
    lowest = hn::Min(lowest, hn::IfThenElse(used, row, hn::Set(di, highest_int)));
    highest = hn::Max(highest, hn::IfThenElse(used, row, hn::Set(di, lowest_int)));
  }
  const int first = hn::GetLane(hn::MinOfLanes(di, lowest));
  const int last = hn::GetLane(hn::MaxOfLanes(di, highest));
  return first > last ? ImageRows() : ImageRows{.first = first, .count = last - first + 1};
}

void add_points(const Directions& directions, std::span<const std::uint8_t> is_object,
                const ImageRows& rows, NearestPoint* nearest, ObjectRanges* objects) {
  const FloatTag d;
  const IntTag di;
  alignas(64) std::array<std::int32_t, lanes> places;
  alignas(64) std::array<std::int32_t, lanes> ranges;  // 0: not used
  alignas(64) std::array<std::int32_t, lanes> elevations;
  for (std::size_t first = 0; first < is_object.size(); first += hn::Lanes(d)) {
    const FloatVector range = hn::Load(d, directions.ranges() + first);
    const auto used = is_used(range);
    hn::Store(places_of(rows, hn::Load(di, directions.rows() + first),
                        hn::Load(di, directions.columns() + first)),
              di, places.data());
    const FloatVector units = hn::Mul(range, hn::Set(d, 1 / RangeImage::unit));
    hn::Store(hn::ConvertTo(di, hn::IfThenElseZero(used, units)), di, ranges.data());
    const FloatVector elevation = hn::Load(d, directions.elevations() + first);
    hn::Store(hn::ConvertTo(di, hn::Mul(elevation, hn::Set(d, 1 / RangeImage::elevation_unit))), di,
              elevations.data());
    const std::uint32_t are_used = bits_of(d, used);
    const std::size_t count = std::min(hn::Lanes(d), is_object.size() - first);
    for (std::size_t k = 0; k < count; ++k) {
      if ((are_used >> k & 1U) == 0) continue;
      const auto place = static_cast<std::size_t>(places[k]);
      const auto its_range = static_cast<std::uint16_t>(ranges[k]);
      const NearestPoint point(its_range, static_cast<std::int16_t>(elevations[k]));
      nearest[place] = std::min(nearest[place], point);
      const bool has_object = is_object[first + k] != 0;
      ObjectRanges& pixel = objects[place];
      pixel.nearest = std::min(pixel.nearest, has_object ? its_range : no_range);
      pixel.farthest = std::max(pixel.farthest, has_object ? its_range : std::uint16_t{0});
    }
  }
}

}  // namespace
}  // namespace flagstone::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace flagstone {
namespace {
HWY_EXPORT(find_rows);
HWY_EXPORT(add_points);
}  // namespace

void RangeImage::clear(const ImageRows& rows) {
  rows_ = rows;
  const auto pixels = static_cast<std::size_t>(rows_.in_memory() * stride);
  nearest_.assign(pixels, {});
  objects_.assign(pixels, {});
}

void RangeImage::build(const Directions& directions, std::span<const std::uint8_t> is_object) {
  clear(HWY_DYNAMIC_DISPATCH(find_rows)(directions, is_object.size()));
  HWY_DYNAMIC_DISPATCH(add_points)(directions, is_object, rows_, nearest_.data(), objects_.data());
  repeat_edges();
}

void RangeImage::repeat_edges() noexcept {
  for (int row = 0; row < rows_.count; ++row) {
    const auto repeat = [&](auto& pixels) {
      auto* const first = pixels.data() + (row + ImageRows::empty) * stride + 1;
      first[-1] = first[PixelGrid::columns - 1];
      first[PixelGrid::columns] = first[0];
    };
    repeat(nearest_);
    repeat(objects_);
  }
}

}  // namespace flagstone
#endif
