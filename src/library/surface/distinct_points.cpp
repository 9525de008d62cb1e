// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "library/surface/distinct_points.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "library/surface/distinct_points.cpp"
#include <hwy/foreach_target.h>
// The above includes this file once for each instruction set.
#include "library/core/simd/lanes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace flagstone::surface::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using namespace flagstone::HWY_NAMESPACE;  // NOLINT(google-build-using-namespace): its other half

/// Copies each point that does not equal an earlier one.
std::size_t copy_unlike_earlier(std::span<const PackedPoint> points, PackedPoint* to) {
  const IntTag di;
  const std::size_t length = hn::Lanes(di);
  const auto* const all = reinterpret_cast<const std::int32_t*>(points.data());
  std::size_t count = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const IntVector point = hn::Set(di, all[i]);
    const std::size_t whole = i / length * length;
    auto equal = hn::FirstN(di, 0);
    for (std::size_t k = 0; k < whole; k += length) {
      equal = hn::Or(equal, hn::Eq(hn::LoadU(di, all + k), point));
    }
    const auto earlier = hn::FirstN(di, i - whole);
    equal = hn::Or(equal, hn::And(earlier, hn::Eq(hn::LoadU(di, all + whole), point)));
    to[count] = points[i];
    count += static_cast<std::size_t>(hn::AllFalse(di, equal));
  }
  return count;
}

}  // namespace
}  // namespace flagstone::surface::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace flagstone::surface {
namespace {
HWY_EXPORT(copy_unlike_earlier);

/// Up to this many points are compared with each other; more are sorted.
constexpr std::size_t most_to_compare = 256;

/// Sorts by digits of eight bits, lowest first, in time proportional to the number of points.
/// Returns the sorted points: `points` or `scratch`.
std::span<PackedPoint> sort_by_digits(std::span<PackedPoint> points, PackedPoint* scratch) {
  constexpr unsigned digits = 4;
  constexpr unsigned values = 256;
  const auto digit_of = [](PackedPoint point, unsigned digit) {
    return point >> (8 * digit) & (values - 1);
  };
  std::array<std::array<std::uint32_t, values>, digits> counts{};
  for (const PackedPoint point : points) {
    for (unsigned digit = 0; digit < digits; ++digit) ++counts[digit][digit_of(point, digit)];
  }
  std::span<PackedPoint> from = points;
  std::span<PackedPoint> to(scratch, points.size());
  for (unsigned digit = 0; digit < digits; ++digit) {
    std::array<std::uint32_t, values>& places = counts[digit];
    if (places[digit_of(from.front(), digit)] == from.size()) continue;  // all are equal
    std::uint32_t sum = 0;
    for (std::uint32_t& place : places) sum += std::exchange(place, sum);
    for (const PackedPoint point : from) to[places[digit_of(point, digit)]++] = point;
    std::swap(from, to);
  }
  return from;
}

}  // namespace

std::size_t copy_distinct(std::span<PackedPoint> points, PackedPoint* scratch,
                          PackedPoint* to) noexcept {
  if (points.size() <= most_to_compare) {
    return HWY_DYNAMIC_DISPATCH(copy_unlike_earlier)(points, to);
  }
  const std::span<PackedPoint> sorted = sort_by_digits(points, scratch);
  return static_cast<std::size_t>(std::ranges::unique_copy(sorted, to).out - to);
}

}  // namespace flagstone::surface
#endif
