// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/bench/read_baseline.hpp"

#include <array>
#include <cstddef>

// Highway compiles this file once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "lab/bench/read_baseline.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace flagstone::bench::HWY_NAMESPACE {
namespace {

#if HWY_TARGET == HWY_SCALAR

// Without vectors, the plain loop below processes all points.
std::size_t pass_of_4(const float*, std::size_t, std::uint8_t*) { return 0; }
std::size_t pass_of_3(const float*, std::size_t, std::uint8_t*) { return 0; }

#else

namespace hn = hwy::HWY_NAMESPACE;

using Floats = hn::ScalableTag<float>;
using Words = hn::RebindToUnsigned<Floats>;

/// 1 in lanes with z above both x and y. Uses comparisons, because minimum and maximum treat NaN
/// differently on different instruction sets.
template <class V>
HWY_INLINE hn::Vec<Words> above(V x, V y, V z) {
  const auto is_above = hn::And(hn::Gt(z, x), hn::Gt(z, y));
  return hn::IfThenElseZero(hn::RebindMask(Words(), is_above), hn::Set(Words(), 1));
}

HWY_INLINE void store_bytes(hn::Vec<Words> words, std::uint8_t* bytes) {
  constexpr hn::Rebind<std::uint8_t, Words> d;
  hn::StoreU(hn::TruncateTo(d, words), d, bytes);
}

/// Processes as many points as fill whole vectors, and returns their number. Leaves at least one
/// point, because the fourth float of the last point may not be readable.
std::size_t pass_of_4(const float* points, std::size_t count, std::uint8_t* bytes) {
  constexpr Floats d;
  const std::size_t lanes = hn::Lanes(d);
  // Transposing within blocks of four floats needs fewer shuffles than LoadInterleaved4. With
  // AVX-512 this takes a quarter less time if the scan is in the second-level cache, and a
  // twentieth less from the third level. Word 4 b + k of the result then belongs to point b of
  // vector k; one permutation restores the order.
  HWY_ALIGN std::array<std::uint32_t, HWY_MAX_BYTES / sizeof(float)> order{};
  const std::size_t points_per_vector = lanes / 4;
  for (std::size_t i = 0; i < lanes; ++i) {
    order[i] = static_cast<std::uint32_t>(4 * (i % points_per_vector) + i / points_per_vector);
  }
  const auto indices = hn::SetTableIndices(Words(), order.data());
  const hn::RepartitionToWide<Floats> pairs;
  std::size_t i = 0;
  for (; i + lanes < count; i += lanes) {
    const float* const p = points + 4 * i;
    const auto a = hn::LoadU(d, p);
    const auto b = hn::LoadU(d, p + lanes);
    const auto c = hn::LoadU(d, p + 2 * lanes);
    const auto e = hn::LoadU(d, p + 3 * lanes);
    const auto xy_ab = hn::BitCast(pairs, hn::InterleaveLower(d, a, b));
    const auto xy_ce = hn::BitCast(pairs, hn::InterleaveLower(d, c, e));
    const auto zw_ab = hn::BitCast(pairs, hn::InterleaveUpper(d, a, b));
    const auto zw_ce = hn::BitCast(pairs, hn::InterleaveUpper(d, c, e));
    const auto x = hn::BitCast(d, hn::InterleaveLower(pairs, xy_ab, xy_ce));
    const auto y = hn::BitCast(d, hn::InterleaveUpper(pairs, xy_ab, xy_ce));
    const auto z = hn::BitCast(d, hn::InterleaveLower(pairs, zw_ab, zw_ce));
    store_bytes(hn::TableLookupLanes(above(x, y, z), indices), bytes + i);
  }
  return i;
}

/// Like pass_of_4, for points of three floats.
std::size_t pass_of_3(const float* points, std::size_t count, std::uint8_t* bytes) {
  constexpr Floats d;
  const std::size_t lanes = hn::Lanes(d);
  std::size_t i = 0;
  for (; i + lanes <= count; i += lanes) {
    hn::Vec<Floats> x;
    hn::Vec<Floats> y;
    hn::Vec<Floats> z;
    hn::LoadInterleaved3(d, points + 3 * i, x, y, z);
    store_bytes(above(x, y, z), bytes + i);
  }
  return i;
}

#endif

}  // namespace
}  // namespace flagstone::bench::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace flagstone::bench {

HWY_EXPORT(pass_of_4);
HWY_EXPORT(pass_of_3);

void read_baseline(CloudView cloud, std::span<std::uint8_t> bytes) noexcept {
  const CloudLayout& layout = cloud.layout();
  const bool is_packed =
      layout.x == 0 && layout.y == sizeof(float) && layout.z == 2 * sizeof(float);
  const auto* const floats = static_cast<const float*>(cloud.data());
  std::size_t done = 0;
  if (is_packed && layout.stride == 4 * sizeof(float)) {
    done = HWY_DYNAMIC_DISPATCH(pass_of_4)(floats, cloud.size(), bytes.data());
  } else if (is_packed && layout.stride == 3 * sizeof(float)) {
    done = HWY_DYNAMIC_DISPATCH(pass_of_3)(floats, cloud.size(), bytes.data());
  }
  for (std::size_t i = done; i < cloud.size(); ++i) {
    const Point p = cloud[i];
    bytes[i] = p.z > p.x && p.z > p.y ? 1 : 0;
  }
}

}  // namespace flagstone::bench
#endif
