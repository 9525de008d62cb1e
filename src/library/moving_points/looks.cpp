// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "library/moving_points/looks.hpp"

#include <hwy/cache_control.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "library/moving_points/looks.cpp"
#include <hwy/foreach_target.h>
// foreach_target.h includes this file once per instruction set.
#include "library/moving_points/pixel_places-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace flagstone::HWY_NAMESPACE {
namespace {

// A range with its margin for errors of poses and measurements, in units of RangeImage::unit.
struct RangeInterval {
  std::uint16_t low, high;  // exclusive, inclusive

  explicit RangeInterval(float range) noexcept {
    constexpr float units_per_metre = 1 / RangeImage::unit;
    const float margin = 0.4F + 0.01F * range;  // metres
    low = static_cast<std::uint16_t>((range - margin) * units_per_metre);
    high = static_cast<std::uint16_t>((range + margin) * units_per_metre);
  }
};

#if HWY_TARGET == HWY_SCALAR
// One of three pixels in a row has an object in the interval.
HWY_INLINE bool has_object(const ObjectRanges* pixels, const RangeInterval& range) {
  const auto contains = [&](std::uint16_t measured) {
    return measured > range.low && measured <= range.high;
  };
  for (std::size_t k = 0; k < 3; ++k) {
    if (contains(pixels[k].nearest) || contains(pixels[k].farthest)) return true;
  }
  return false;
}

// The object is in the pixel after `pixels` or one of its eight neighbours.
HWY_INLINE bool is_occupied(const ObjectRanges* pixels, const RangeInterval& range) {
  constexpr std::ptrdiff_t up = RangeImage::stride;
  return has_object(pixels, range) || has_object(pixels + up, range) ||
         has_object(pixels - up, range);
}
#else
// An object is in the pixel after `pixels` or one of its eight neighbours. Three pixels of a row
// are three quarters of a vector.
HWY_INLINE bool is_occupied(const ObjectRanges* pixels, const RangeInterval& range) {
  const hn::Full128<std::uint16_t> d;
  const auto first = hn::Set(d, static_cast<std::uint16_t>(range.low + 1));
  const auto last = hn::Set(d, static_cast<std::uint16_t>(range.high - range.low - 1));
  const auto in_row = [&](std::ptrdiff_t row) HWY_ATTR {
    const auto ranges =
        hn::LoadU(d, reinterpret_cast<const std::uint16_t*>(pixels + row * RangeImage::stride));
    const auto from_first = hn::Sub(ranges, first);  // modulo 2^16: lower ranges become large
    return hn::Eq(hn::Min(from_first, last), from_first);
  };
  const auto found = hn::Or(hn::Or(in_row(0), in_row(1)), in_row(-1));
  return !hn::AllFalse(d, hn::And(found, hn::FirstN(d, 6)));
}
#endif

// The ray of the pixel passes the point closely and ends behind it, and no edge of an object is
// next to it.
HWY_INLINE bool is_seen_through(NearestPoint nearest, const ObjectRanges* pixels,
                                const RangeInterval& range, float metres, float elevation) {
  constexpr float max_distance_of_ray = 0.3F;  // metres
  if (nearest.range() == no_range || nearest.range() <= range.high) return false;
  const float measured = static_cast<float>(nearest.elevation()) * RangeImage::elevation_unit;
  if (!(metres * std::abs(measured - elevation) < max_distance_of_ray)) return false;
  return pixels[0].nearest > range.low && pixels[2].nearest > range.low;
}

/// What some consecutive points need for their looks.
struct PreparedLooks {
  alignas(64) std::array<std::int32_t, lanes> places;
  alignas(64) std::array<float, lanes> ranges;  // metres; 0: no look
};

// Loads the pixels into the cache: those of most views are not in it.
HWY_INLINE void prepare(const RangeImage& image, const Directions& directions, std::size_t begin,
                        PreparedLooks& looks) {
  constexpr float min_range = 0.5F;   // metres; nearer, directions are not reliable
  constexpr float max_range = 200.F;  // metres
  const FloatTag d;
  const IntTag di;
  for (std::size_t k = 0; k < lanes; k += hn::Lanes(d)) {
    const FloatVector range = hn::Load(d, directions.ranges() + begin + k);
    const auto used =
        hn::And(hn::Gt(range, hn::Set(d, min_range)), hn::Lt(range, hn::Set(d, max_range)));
    hn::Store(hn::IfThenElseZero(used, range), d, looks.ranges.data() + k);
    hn::Store(places_of(image.rows(), hn::Load(di, directions.rows() + begin + k),
                        hn::Load(di, directions.columns() + begin + k)),
              di, looks.places.data() + k);
  }
  for (const std::int32_t place : looks.places) {
    const ObjectRanges* const pixel = image.objects() + place;
    hwy::Prefetch(pixel - RangeImage::stride);
    hwy::Prefetch(pixel);
    hwy::Prefetch(pixel + RangeImage::stride);
    hwy::Prefetch(image.nearest() + place);
  }
}

void look_at_points(const RangeImage& image, const Directions& directions,
                    std::vector<LookCounts>& counts) {
  if (counts.empty()) return;
  std::array<PreparedLooks, 2> prepared;
  prepare(image, directions, 0, prepared[0]);
  for (std::size_t begin = 0; begin < counts.size(); begin += lanes) {
    const std::size_t next = begin + lanes;
    if (next < counts.size()) prepare(image, directions, next, prepared[next / lanes % 2]);
    const PreparedLooks& looks = prepared[begin / lanes % 2];
    const std::size_t count = std::min(lanes, counts.size() - begin);
    for (std::size_t k = 0; k < count; ++k) {
      const float metres = looks.ranges[k];
      if (metres == 0) continue;
      const std::int32_t place = looks.places[k];
      const ObjectRanges* const pixels = image.objects() + place - 1;
      const RangeInterval range(metres);
      if (is_occupied(pixels, range)) {
        ++counts[begin + k].occupied;
      } else if (is_seen_through(image.nearest()[place], pixels, range, metres,
                                 directions.elevation(begin + k))) {
        ++counts[begin + k].through;
      }
    }
  }
}

}  // namespace
}  // namespace flagstone::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace flagstone {
namespace {
HWY_EXPORT(look_at_points);
}  // namespace

void add_looks(const RangeImage& image, const Directions& directions,
               std::vector<LookCounts>& counts) noexcept {
  HWY_DYNAMIC_DISPATCH(look_at_points)(image, directions, counts);
}

}  // namespace flagstone
#endif
