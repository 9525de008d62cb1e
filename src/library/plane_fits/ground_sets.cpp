// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "library/plane_fits/ground_sets.hpp"

#include <algorithm>
#include <array>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "library/plane_fits/ground_sets.cpp"
#include <hwy/foreach_target.h>
// foreach_target.h includes this file once per instruction set.
#include "library/core/simd/lanes-inl.hpp"
#include "library/plane_fits/ground_set-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace flagstone::plane_fits::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using namespace flagstone::HWY_NAMESPACE;  // NOLINT(google-build-using-namespace): its other half

/// Sums x, y, z, xx, xy, xz, yy, yz, zz, in the order of Moments.
inline constexpr std::size_t sum_count = 9;

/// Each of these sums in 16 lanes.
template <class T>
using LaneTable = std::array<std::array<T, lanes>, sum_count>;

// Points outside the set add nothing: their coordinates count as 0, or a masked addition skips them
// on targets where masks are free. Both give the same sums.

template <class M, class V>
HWY_INLINE DoubleVector widen_if(DoubleTag d, M inside, V v) {
  return hn::PromoteTo(d, hn::IfThenElseZero(inside, v));
}
template <class M>
HWY_INLINE DoubleVector add_if(DoubleTag /*d*/, M /*inside*/, DoubleVector sum, DoubleVector v) {
  return hn::Add(sum, v);
}

#if HWY_TARGET <= HWY_AVX3
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

/// The sums of one vector of lanes.
template <class SumTag>
class LaneSums {
 public:
  HWY_INLINE LaneSums() : x_(hn::Zero(SumTag())) {
    y_ = z_ = xx_ = xy_ = xz_ = yy_ = yz_ = zz_ = x_;
  }

  template <class M, class V>
  HWY_INLINE void add(M inside, V px, V py, V pz) {
    const SumTag ds;
    const Sum x = widen_if(ds, inside, px);
    const Sum y = widen_if(ds, inside, py);
    const Sum z = widen_if(ds, inside, pz);
    x_ = add_if(ds, inside, x_, x);
    y_ = add_if(ds, inside, y_, y);
    z_ = add_if(ds, inside, z_, z);
    xx_ = add_if(ds, inside, xx_, hn::Mul(x, x));
    xy_ = add_if(ds, inside, xy_, hn::Mul(x, y));
    xz_ = add_if(ds, inside, xz_, hn::Mul(x, z));
    yy_ = add_if(ds, inside, yy_, hn::Mul(y, y));
    yz_ = add_if(ds, inside, yz_, hn::Mul(y, z));
    zz_ = add_if(ds, inside, zz_, hn::Mul(z, z));
  }

  HWY_INLINE void store(LaneTable<hn::TFromD<SumTag>>& sums, std::size_t lane) const {
    const SumTag ds;
    hn::StoreU(x_, ds, sums[0].data() + lane);
    hn::StoreU(y_, ds, sums[1].data() + lane);
    hn::StoreU(z_, ds, sums[2].data() + lane);
    hn::StoreU(xx_, ds, sums[3].data() + lane);
    hn::StoreU(xy_, ds, sums[4].data() + lane);
    hn::StoreU(xz_, ds, sums[5].data() + lane);
    hn::StoreU(yy_, ds, sums[6].data() + lane);
    hn::StoreU(yz_, ds, sums[7].data() + lane);
    hn::StoreU(zz_, ds, sums[8].data() + lane);
  }

 private:
  using Sum = hn::Vec<SumTag>;
  Sum x_, y_, z_, xx_, xy_, xz_, yy_, yz_, zz_;
};

// Sixteen lanes are always added in halves: lane l and lane l + 8, then + 4, + 2, + 1.

/// The sum of the four quarters of sixteen lanes.
template <class D>
HWY_INLINE hn::Vec<D> sum_of_quarters(D d, const hn::TFromD<D>* sums) {
  const auto quarter = [&](std::size_t k) HWY_ATTR { return hn::LoadU(d, sums + 4 * k); };
  return hn::Add(hn::Add(quarter(0), quarter(2)), hn::Add(quarter(1), quarter(3)));
}

/// Adds the sums of the lanes to the totals.
template <class T>
HWY_INLINE void add_lanes(const LaneTable<T>& sums, std::array<double, sum_count>& totals) {
  const hn::CappedTag<T, 4> d;
  for (std::size_t k = 0; k < sum_count; ++k) {
    std::array<T, 4> quarters;
    for (std::size_t lane = 0; lane < 4; lane += hn::Lanes(d)) {
      hn::StoreU(sum_of_quarters(d, sums[k].data() + lane), d, quarters.data() + lane);
    }
    totals[k] += static_cast<double>((quarters[0] + quarters[2]) + (quarters[1] + quarters[3]));
  }
}

#if HWY_TARGET != HWY_SCALAR

/// Adds the sums of the lanes to the totals, four sums at a time.
HWY_INLINE void add_lanes(const LaneTable<float>& sums, std::array<double, sum_count>& totals) {
  const hn::CappedTag<float, 4> d;
  std::array<float, 12> sums_of_lanes;
  for (std::size_t k = 0; k < sum_count; k += 4) {
    const auto of = [&](std::size_t i) HWY_ATTR {
      return sum_of_quarters(d, sums[std::min(k + i, sum_count - 1)].data());
    };
    const auto halves = [&](std::size_t i) HWY_ATTR {  // lanes: of(i), of(i + 1), of(i), of(i + 1)
      const auto a = of(i);
      const auto b = of(i + 1);
      return hn::Add(hn::InterleaveLower(d, a, b), hn::InterleaveUpper(d, a, b));
    };
    const auto low = halves(0);
    const auto high = halves(2);
    hn::StoreU(hn::Add(hn::ConcatLowerLower(d, high, low), hn::ConcatUpperUpper(d, high, low)), d,
               sums_of_lanes.data() + k);
  }
  for (std::size_t k = 0; k < sum_count; ++k) totals[k] += static_cast<double>(sums_of_lanes[k]);
}

#endif

/// Adds the sums of the lanes to the totals in double precision.
HWY_INLINE void add_lanes_exactly(const LaneTable<float>& sums,
                                  std::array<double, sum_count>& totals) {
  const DoubleTag d;
  const hn::Rebind<float, DoubleTag> df;
  for (std::size_t k = 0; k < sum_count; ++k) {
    DoubleVector sum = hn::Zero(d);
    for (std::size_t lane = 0; lane < lanes; lane += hn::Lanes(d)) {
      sum = hn::Add(sum, hn::PromoteTo(d, hn::LoadU(df, sums[k].data() + lane)));
    }
    totals[k] += hn::GetLane(hn::SumOfLanes(d, sum));  // exact, so in any order
  }
}

/// Computes the moments of the points of a bin for which `inside(d, first element, x, y, z)` is
/// true, in vectors of `SumTag`.
template <class SumTag, Precision precision, class Inside>
HWY_INLINE void sum_bin(const BinBatch& batch, std::size_t bin, MomentsBatch& moments,
                        const Inside& inside) {
  const SumTag ds;
  const hn::Rebind<float, SumTag> d;
  const float* HWY_RESTRICT x = batch.x(bin);
  const float* HWY_RESTRICT y = batch.y(bin);
  const float* z = batch.z(bin);
  constexpr std::size_t most_places = 64 * lanes;  // per sum in single precision
  const std::size_t places = batch.places(bin);
  std::size_t count = 0;
  std::array<double, sum_count> totals{};
  for (std::size_t begin = 0; begin < places; begin += most_places) {
    const std::size_t end = std::min(begin + most_places, places);
    HWY_ALIGN LaneTable<hn::TFromD<SumTag>> sums;
    for (std::size_t lane = 0; lane < lanes; lane += hn::Lanes(ds)) {
      LaneSums<SumTag> lane_sums;
      for (std::size_t i = begin + lane; i < end; i += lanes) {
        const auto px = hn::Load(d, x + i);
        const auto py = hn::Load(d, y + i);
        auto pz = hn::Load(d, z + i);
        const auto mask = inside(d, i, px, py, pz);
        count += hn::CountTrue(d, mask);
        lane_sums.add(mask, px, py, pz);
      }
      lane_sums.store(sums, lane);
    }
    if constexpr (precision == Precision::exact) {
      add_lanes_exactly(sums, totals);
    } else {
      add_lanes(sums, totals);
    }
  }
  moments.count[bin] = static_cast<double>(count);
  for (std::size_t k = 0; k < 3; ++k) moments.sum[k][bin] = totals[k];
  for (std::size_t k = 0; k < 6; ++k) moments.squares[k][bin] = totals[3 + k];
}

template <Precision precision>
void sum_first_sets(BinBatch& batch, const std::array<FirstSet, batch_size>& sets,
                    MomentsBatch& moments) {
  for (std::size_t bin = 0; bin < batch.count(); ++bin) {
    const FirstSet& set = sets[bin];
    float* shifted = batch.z(bin);
    sum_bin<FloatTag, precision>(
        batch, bin, moments,
        [&](FloatTag d, std::size_t i, FloatVector, FloatVector, FloatVector& z) HWY_ATTR {
          z = hn::Sub(z, hn::Set(d, set.origin));
          if constexpr (precision == Precision::exact) {
            const auto exact = hn::Le(hn::Abs(z), hn::Set(d, ExactGrid::reach));
            z = hn::IfThenElse(exact, z, hn::Set(d, std::numeric_limits<float>::infinity()));
          }
          hn::Store(z, d, shifted + i);
          return hn::And(hn::Lt(z, hn::Set(d, set.top)), hn::Ge(z, hn::Set(d, set.bottom)));
        });
  }
}

void sum_first_bins(BinBatch& batch, const std::array<FirstSet, batch_size>& sets,
                    Precision precision, MomentsBatch& moments) {
  if (precision == Precision::exact) {
    sum_first_sets<Precision::exact>(batch, sets, moments);
  } else {
    sum_first_sets<Precision::single>(batch, sets, moments);
  }
}

template <class SumTag, Precision precision>
HWY_INLINE void sum_set(const BinBatch& batch, std::size_t bin, const GroundSet& set,
                        MomentsBatch& moments) {
  sum_bin<SumTag, precision>(batch, bin, moments,
                             [&](auto d, std::size_t, auto x, auto y, auto z)
                                 HWY_ATTR { return in_set(d, x, y, z, set); });
}

void sum_bins(const BinBatch& batch, const GroundSets& sets, BinMask wanted, Precision precision,
              MomentsBatch& moments) {
  for (std::size_t bin = 0; bin < batch.count(); ++bin) {
    if ((wanted >> bin & 1U) == 0) continue;
    if (precision == Precision::single) {
      sum_set<FloatTag, Precision::single>(batch, bin, sets[bin], moments);
    } else if (precision == Precision::full) {
      sum_set<DoubleTag, Precision::full>(batch, bin, sets[bin], moments);
    } else {
      sum_set<FloatTag, Precision::exact>(batch, bin, sets[bin], moments);
    }
  }
}

}  // namespace
}  // namespace flagstone::plane_fits::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace flagstone::plane_fits {
namespace {
HWY_EXPORT(sum_bins);
HWY_EXPORT(sum_first_bins);
}  // namespace

void sum_moments(const BinBatch& batch, const GroundSets& sets, BinMask wanted, Precision precision,
                 MomentsBatch& moments) noexcept {
  HWY_DYNAMIC_DISPATCH(sum_bins)(batch, sets, wanted, precision, moments);
}

void sum_first_moments(BinBatch& batch, const std::array<FirstSet, batch_size>& sets,
                       Precision precision, MomentsBatch& moments) noexcept {
  HWY_DYNAMIC_DISPATCH(sum_first_bins)(batch, sets, precision, moments);
}

}  // namespace flagstone::plane_fits
#endif
