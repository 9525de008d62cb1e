// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "patchwork/ground_sets.hpp"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "patchwork/ground_sets.cpp"
#include <hwy/foreach_target.h>
// The above includes this file once for each instruction set.
#include "core/simd/lanes-inl.hpp"
#include "patchwork/ground_set-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace flagstone::patchwork::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using namespace flagstone::HWY_NAMESPACE;  // NOLINT(google-build-using-namespace): its other half

/// Sums x, y, z, xx, xy, xz, yy, yz, zz, in the order of Moments.
inline constexpr std::size_t sum_count = 9;

// A point outside of the set adds nothing: its coordinates count as 0, or, where an addition can
// have a mask for free, it is not added. Both give the same sums.

template <class M, class V>
HWY_INLINE DoubleVector widen_if(DoubleTag d, M inside, V v) {
  return hn::PromoteTo(d, hn::IfThenElseZero(inside, v));
}
template <class M>
HWY_INLINE DoubleVector add_if(DoubleTag /*d*/, M /*inside*/, DoubleVector sum, DoubleVector v) {
  return hn::Add(sum, v);
}

#if HWY_TARGET == HWY_AVX3
template <class M>
HWY_INLINE FloatVector widen_if(FloatTag /*d*/, M /*inside*/, FloatVector v) {
  return v;
}
template <class M>
HWY_INLINE FloatVector add_if(FloatTag /*d*/, M inside, FloatVector sum, FloatVector v) {
  return hn::IfThenElse(inside, hn::Add(sum, v), sum);
}
#else
template <class M>
HWY_INLINE FloatVector widen_if(FloatTag /*d*/, M inside, FloatVector v) {
  return hn::IfThenElseZero(inside, v);
}
template <class M>
HWY_INLINE FloatVector add_if(FloatTag /*d*/, M /*inside*/, FloatVector sum, FloatVector v) {
  return hn::Add(sum, v);
}
#endif

/// Sums over the set's points among `places` places, in vectors of `SumTag`, into 16 lanes each;
/// returns how many points they are.
template <class SumTag>
HWY_INLINE std::size_t sum_lanes(const float* HWY_RESTRICT xs, const float* HWY_RESTRICT ys,
                                 const float* HWY_RESTRICT zs, std::size_t places,
                                 const GroundSet& set,
                                 hn::TFromD<SumTag> (&HWY_RESTRICT sums)[sum_count][lanes]) {
  const SumTag ds;
  const hn::Rebind<float, SumTag> d;
  using Sum = hn::Vec<SumTag>;
  std::size_t count = 0;
  for (std::size_t lane = 0; lane < lanes; lane += hn::Lanes(ds)) {
    Sum sx = hn::Zero(ds);
    Sum sy = sx;
    Sum sz = sx;
    Sum sxx = sx;
    Sum sxy = sx;
    Sum sxz = sx;
    Sum syy = sx;
    Sum syz = sx;
    Sum szz = sx;
    for (std::size_t i = lane; i < places; i += lanes) {
      const auto px = hn::Load(d, xs + i);
      const auto py = hn::Load(d, ys + i);
      const auto pz = hn::Load(d, zs + i);
      const auto inside = in_set(d, px, py, pz, set);
      count += hn::CountTrue(d, inside);
      const Sum x = widen_if(ds, inside, px);
      const Sum y = widen_if(ds, inside, py);
      const Sum z = widen_if(ds, inside, pz);
      sx = add_if(ds, inside, sx, x);
      sy = add_if(ds, inside, sy, y);
      sz = add_if(ds, inside, sz, z);
      sxx = add_if(ds, inside, sxx, hn::Mul(x, x));
      sxy = add_if(ds, inside, sxy, hn::Mul(x, y));
      sxz = add_if(ds, inside, sxz, hn::Mul(x, z));
      syy = add_if(ds, inside, syy, hn::Mul(y, y));
      syz = add_if(ds, inside, syz, hn::Mul(y, z));
      szz = add_if(ds, inside, szz, hn::Mul(z, z));
    }
    hn::StoreU(sx, ds, sums[0] + lane);
    hn::StoreU(sy, ds, sums[1] + lane);
    hn::StoreU(sz, ds, sums[2] + lane);
    hn::StoreU(sxx, ds, sums[3] + lane);
    hn::StoreU(sxy, ds, sums[4] + lane);
    hn::StoreU(sxz, ds, sums[5] + lane);
    hn::StoreU(syy, ds, sums[6] + lane);
    hn::StoreU(syz, ds, sums[7] + lane);
    hn::StoreU(szz, ds, sums[8] + lane);
  }
  return count;
}

/// The sum of sixteen lanes: always halves upon halves.
template <class T>
HWY_INLINE double sum_of_lanes(T (&HWY_RESTRICT sums)[lanes]) {
  const hn::CappedTag<T, 4> d;
  for (std::size_t lane = 0; lane < 4; lane += hn::Lanes(d)) {
    const auto quarter = [&](std::size_t k) HWY_ATTR { return hn::LoadU(d, sums + 4 * k + lane); };
    hn::StoreU(hn::Add(hn::Add(quarter(0), quarter(2)), hn::Add(quarter(1), quarter(3))), d,
               sums + lane);
  }
  return static_cast<double>((sums[0] + sums[2]) + (sums[1] + sums[3]));
}

template <class SumTag>
void sum_bin(const BinBatch& batch, std::size_t bin, const GroundSet& set, MomentsBatch& moments) {
  constexpr std::size_t most_places = 64 * lanes;  // of sums in single precision
  std::size_t count = 0;
  double totals[sum_count] = {};
  const std::size_t places = batch.places(bin);
  for (std::size_t begin = 0; begin < places; begin += most_places) {
    HWY_ALIGN hn::TFromD<SumTag> sums[sum_count][lanes];
    count += sum_lanes<SumTag>(batch.x(bin) + begin, batch.y(bin) + begin, batch.z(bin) + begin,
                               std::min(most_places, places - begin), set, sums);
    for (std::size_t k = 0; k < sum_count; ++k) totals[k] += sum_of_lanes(sums[k]);
  }
  moments.count[bin] = static_cast<double>(count);
  for (std::size_t k = 0; k < 3; ++k) moments.sum[k][bin] = totals[k];
  for (std::size_t k = 0; k < 6; ++k) moments.squares[k][bin] = totals[3 + k];
}

void sum_bins(const BinBatch& batch, const GroundSets& sets, BinMask wanted, Precision precision,
              MomentsBatch& moments) {
  for (std::size_t bin = 0; bin < batch.count(); ++bin) {
    if ((wanted >> bin & 1U) == 0) continue;
    if (precision == Precision::single) {
      sum_bin<FloatTag>(batch, bin, sets[bin], moments);
    } else {
      sum_bin<DoubleTag>(batch, bin, sets[bin], moments);
    }
  }
}

void shift(float* heights, std::size_t places, float origin) {
  const FloatTag d;
  for (std::size_t i = 0; i < places; i += hn::Lanes(d)) {
    hn::Store(hn::Sub(hn::Load(d, heights + i), hn::Set(d, origin)), d, heights + i);
  }
}

}  // namespace
}  // namespace flagstone::patchwork::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace flagstone::patchwork {
namespace {
HWY_EXPORT(sum_bins);
HWY_EXPORT(shift);
}  // namespace

void sum_moments(const BinBatch& batch, const GroundSets& sets, BinMask wanted,
                 Precision precision, MomentsBatch& moments) noexcept {
  HWY_DYNAMIC_DISPATCH(sum_bins)(batch, sets, wanted, precision, moments);
}

void shift_heights(BinBatch& batch, const std::array<float, batch_size>& origins) noexcept {
  for (std::size_t i = 0; i < batch.count(); ++i) {
    HWY_DYNAMIC_DISPATCH(shift)(batch.z(i), batch.places(i), origins[i]);
  }
}

}  // namespace flagstone::patchwork
#endif
