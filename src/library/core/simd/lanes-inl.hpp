// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
//
// Vector operations for all instruction sets. Included once per instruction set. Better targets
// have lower bits: `HWY_TARGET <= HWY_AVX3` is any kind of AVX-512.
//
// Results are bit-identical on all targets: work is organised in 16 virtual lanes, which are one
// AVX-512 vector, two AVX2 vectors, four SSE4 or NEON vectors, or sixteen numbers in plain C++. The
// result of a lane never depends on the number of lanes per vector, sums over lanes follow one
// fixed tree, and a * b + c is always rounded twice: no target fuses it.

// clang-format off
#if defined(FLAGSTONE_CORE_SIMD_LANES_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef FLAGSTONE_CORE_SIMD_LANES_INL_HPP
#undef FLAGSTONE_CORE_SIMD_LANES_INL_HPP
#else
#define FLAGSTONE_CORE_SIMD_LANES_INL_HPP
#endif
// clang-format on

#include <hwy/highway.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>

HWY_BEFORE_NAMESPACE();
namespace flagstone::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

/// Number of virtual lanes.
inline constexpr std::size_t lanes = 16;

using FloatTag = hn::CappedTag<float, lanes>;
using IntTag = hn::RebindToSigned<FloatTag>;
using DoubleTag = hn::CappedTag<double, lanes>;
using FloatVector = hn::Vec<FloatTag>;
using IntVector = hn::Vec<IntTag>;
using DoubleVector = hn::Vec<DoubleTag>;

/// Looks up element `index` (0 to 15 in each lane) in a table of 16 elements with any alignment.
HWY_INLINE FloatVector lookup_16(const float* HWY_RESTRICT table, IntVector index) {
  const FloatTag d;
#if HWY_TARGET <= HWY_AVX3
  return hn::TableLookupLanes(hn::LoadU(d, table), hn::IndicesFromVec(d, index));
#elif HWY_TARGET == HWY_AVX2
  const IntTag di;
  const auto within = hn::IndicesFromVec(d, hn::And(index, hn::Set(di, 7)));
  const FloatVector low = hn::TableLookupLanes(hn::LoadU(d, table), within);
  const FloatVector high = hn::TableLookupLanes(hn::LoadU(d, table + 8), within);
  return hn::IfThenElse(hn::RebindMask(d, hn::Gt(index, hn::Set(di, 7))), high, low);
#else
  return hn::GatherIndex(d, table, index);
#endif
}

/// A table of 8 numbers with any alignment, kept in a register if it fits.
template <class D>
class Table8 {
 public:
  using T = hn::TFromD<D>;

#if HWY_TARGET <= HWY_AVX2
  HWY_INLINE explicit Table8(const T* table) : numbers_(load(table)) {}

  /// Looks up element `index`, 0 to 7 in each lane.
  HWY_INLINE hn::Vec<D> operator[](IntVector index) const {
    return hn::TableLookupLanes(numbers_, hn::IndicesFromVec(D(), index));
  }

 private:
  static HWY_INLINE hn::Vec<D> load(const T* table) {
#if HWY_TARGET <= HWY_AVX3
    // Loads half a vector: the memory after the table may not be readable.
    return hn::ZeroExtendVector(D(), hn::LoadU(hn::Half<D>(), table));
#else
    return hn::LoadU(D(), table);
#endif
  }

  hn::Vec<D> numbers_;
#else
  HWY_INLINE explicit Table8(const T* table) : numbers_(table) {}
  HWY_INLINE hn::Vec<D> operator[](IntVector index) const {
    return hn::GatherIndex(D(), numbers_, index);
  }

 private:
  const T* numbers_;
#endif
};

/// Looks up element `index` in a table of one vector with any alignment.
HWY_INLINE FloatVector lookup_in_one(const float* HWY_RESTRICT table, IntVector index) {
  const FloatTag d;
#if HWY_TARGET <= HWY_AVX2
  return hn::TableLookupLanes(hn::LoadU(d, table), hn::IndicesFromVec(d, index));
#else
  return hn::GatherIndex(d, table, index);
#endif
}

/// The bits of a mask, lowest lane first.
template <class D>
HWY_INLINE std::uint32_t bits_of(D d, hn::Mask<D> mask) {
#if HWY_TARGET <= HWY_AVX3
  static_cast<void>(d);
  return static_cast<std::uint32_t>(mask.raw);
#else
  HWY_ALIGN std::array<std::uint8_t, 8> bytes{};
  hn::StoreMaskBits(d, mask, bytes.data());
  return bytes[0];
#endif
}

/// Stores one byte for each lane of a vector: 1 if its bit is set, 0 otherwise.
HWY_INLINE void store_bits(std::uint32_t bits, std::uint8_t* to) {
#if HWY_TARGET <= HWY_AVX3
  _mm_storeu_si128(reinterpret_cast<__m128i*>(to),
                   _mm_maskz_set1_epi8(static_cast<__mmask16>(bits), 1));
#elif HWY_TARGET == HWY_AVX2
  const std::uint64_t bytes = _pdep_u64(bits, 0x0101010101010101);
  std::memcpy(to, &bytes, sizeof bytes);
#else
  for (std::size_t lane = 0; lane < hn::MaxLanes(FloatTag()); ++lane) {
    to[lane] = static_cast<std::uint8_t>(bits >> lane & 1U);
  }
#endif
}

/// For each mask of eight lanes and each lane: the number of set lanes up to and including it.
inline constexpr auto counts_up_to = [] {
  std::array<std::uint64_t, 256> counts{};
  for (std::uint32_t mask = 0; mask < 256; ++mask) {
    std::uint64_t count = 0;
    for (std::uint32_t lane = 0; lane < 8; ++lane) {
      count += mask >> lane & 1U;
      counts[mask] |= count << (8 * lane);
    }
  }
  return counts;
}();

/// For each lane the number of set bits up to and including it, less one. Bit 0 must be set.
HWY_INLINE IntVector ranks_of(std::uint32_t bits) {
  constexpr std::uint64_t ones = 0x0101010101010101;
  const std::uint64_t first = counts_up_to[bits & 0xFFU] - ones;
#if HWY_TARGET <= HWY_AVX3
  const std::uint64_t second = counts_up_to[bits >> 8U] + (first >> 56U) * ones;
  return IntVector{_mm512_cvtepu8_epi32(
      _mm_set_epi64x(static_cast<std::int64_t>(second), static_cast<std::int64_t>(first)))};
#elif HWY_TARGET == HWY_AVX2
  return IntVector{_mm256_cvtepu8_epi32(_mm_cvtsi64_si128(static_cast<std::int64_t>(first)))};
#else
  HWY_ALIGN std::array<std::int32_t, lanes> ranks;
  for (std::size_t lane = 0; lane < hn::MaxLanes(IntTag()); ++lane) {
    ranks[lane] = static_cast<std::int32_t>(first >> (8 * lane) & 0xFFU);
  }
  return hn::Load(IntTag(), ranks.data());
#endif
}

/// Integer part of numbers from 0 to 2^31. Faster than hn::ConvertTo, which handles all numbers.
HWY_INLINE IntVector whole_part(FloatVector v) {
#if HWY_TARGET <= HWY_AVX3
  return IntVector{_mm512_cvttps_epi32(v.raw)};
#elif HWY_TARGET == HWY_AVX2
  return IntVector{_mm256_cvttps_epi32(v.raw)};
#elif HWY_TARGET == HWY_SSE4
  return IntVector{_mm_cvttps_epi32(v.raw)};
#else
  return hn::ConvertTo(IntTag(), v);
#endif
}

/// Moves every lane up by one. The first lane becomes the last lane of `before`.
HWY_INLINE IntVector move_up(IntVector v, IntVector before) {
#if HWY_TARGET <= HWY_AVX3
  return IntVector{_mm512_alignr_epi32(v.raw, before.raw, 15)};
#elif HWY_TARGET == HWY_AVX2
  return IntVector{
      _mm256_alignr_epi8(v.raw, _mm256_permute2x128_si256(before.raw, v.raw, 0x21), 12)};
#elif HWY_MAX_BYTES == 16
  return hn::CombineShiftRightBytes<12>(IntTag(), v, before);
#else
  const IntTag di;
  HWY_ALIGN std::array<std::int32_t, 2 * lanes> both{};
  hn::StoreU(before, di, both.data());
  hn::StoreU(v, di, both.data() + hn::Lanes(di));
  return hn::LoadU(di, both.data() + hn::Lanes(di) - 1);
#endif
}

// A pair is two signed integers of 16 bits in one lane of 32 bits, the first one in the low half.

/// For each lane with the pairs (a, b) and (c, d): a * c + b * d.
HWY_INLINE IntVector sum_of_products(IntVector pairs, IntVector factors) {
#if HWY_TARGET <= HWY_AVX3
  return IntVector{_mm512_madd_epi16(pairs.raw, factors.raw)};
#elif HWY_TARGET == HWY_AVX2
  return IntVector{_mm256_madd_epi16(pairs.raw, factors.raw)};
#elif HWY_TARGET == HWY_SSE4
  return IntVector{_mm_madd_epi16(pairs.raw, factors.raw)};
#else
  const auto low = [](IntVector v) HWY_ATTR { return hn::ShiftRight<16>(hn::ShiftLeft<16>(v)); };
  const auto high = [](IntVector v) HWY_ATTR { return hn::ShiftRight<16>(v); };
  return hn::Add(hn::Mul(low(pairs), low(factors)), hn::Mul(high(pairs), high(factors)));
#endif
}

/// Pairs of two integers, each moved to the nearest integer of 16 bits.
HWY_INLINE IntVector saturated_pairs(IntVector first, IntVector second) {
#if HWY_TARGET <= HWY_SSE4
  HWY_ALIGN static constexpr std::int8_t interleave[] = {0, 1, 8,  9,  2, 3, 10, 11,
                                                         4, 5, 12, 13, 6, 7, 14, 15};
  const __m128i order = _mm_load_si128(reinterpret_cast<const __m128i*>(interleave));
#endif
#if HWY_TARGET <= HWY_AVX3
  const __m512i packed = _mm512_packs_epi32(first.raw, second.raw);
  return IntVector{_mm512_shuffle_epi8(packed, _mm512_broadcast_i32x4(order))};
#elif HWY_TARGET == HWY_AVX2
  const __m256i packed = _mm256_packs_epi32(first.raw, second.raw);
  return IntVector{_mm256_shuffle_epi8(packed, _mm256_broadcastsi128_si256(order))};
#elif HWY_TARGET == HWY_SSE4
  return IntVector{_mm_shuffle_epi8(_mm_packs_epi32(first.raw, second.raw), order)};
#else
  const IntTag di;
  const auto saturated = [&](IntVector v) HWY_ATTR {
    return hn::Max(hn::Min(v, hn::Set(di, 32767)), hn::Set(di, -32768));
  };
  return hn::Or(hn::And(saturated(first), hn::Set(di, 0xFFFF)),
                hn::ShiftLeft<16>(saturated(second)));
#endif
}

/// v + 1 in the lanes of the mask, v in the others.
HWY_INLINE IntVector increment_if(hn::Mask<IntTag> mask, IntVector v) {
  const IntTag di;
#if HWY_TARGET <= HWY_AVX3
  return hn::IfThenElse(mask, hn::Add(v, hn::Set(di, 1)), v);
#else
  return hn::Sub(v, hn::VecFromMask(di, mask));  // a set mask is -1
#endif
}

#if HWY_TARGET == HWY_AVX2
/// For each mask of eight lanes: the selected lanes, four bits each, lowest first.
inline constexpr auto picked_lanes = [] {
  std::array<std::uint32_t, 256> picked{};
  for (std::uint32_t mask = 0; mask < 256; ++mask) {
    int shift = 0;
    for (std::uint32_t lane = 0; lane < 8; ++lane) {
      if ((mask >> lane & 1U) == 0) continue;
      picked[mask] |= lane << shift;
      shift += 4;
    }
  }
  return picked;
}();
#elif HWY_TARGET == HWY_SSE4
/// For each mask of four lanes: the selected bytes.
inline constexpr auto picked_bytes = [] {
  std::array<std::array<std::uint8_t, 16>, 16> picked{};
  for (std::size_t mask = 0; mask < 16; ++mask) {
    std::size_t to = 0;
    for (std::uint8_t byte = 0; byte < 16; ++byte) {
      if ((mask >> (byte / 4U) & 1U) != 0) picked[mask][to++] = byte;
    }
  }
  return picked;
}();
#endif

/// Moves the lanes of the mask to the front; the lanes after them are unspecified. Replaces
/// hn::Compress, which with GCC copies its table to the stack in every call.
HWY_INLINE IntVector compress(IntVector v, hn::Mask<IntTag> mask) {
#if HWY_TARGET == HWY_AVX2
  const auto bits = static_cast<unsigned>(
      _mm256_movemask_ps(_mm256_castsi256_ps(hn::VecFromMask(IntTag(), mask).raw)));
  const __m256i packed = _mm256_set1_epi32(static_cast<int>(picked_lanes[bits]));
  const __m256i picked = _mm256_srlv_epi32(packed, _mm256_setr_epi32(0, 4, 8, 12, 16, 20, 24, 28));
  return IntVector{_mm256_permutevar8x32_epi32(v.raw, picked)};
#elif HWY_TARGET == HWY_SSE4
  const auto bits =
      static_cast<unsigned>(_mm_movemask_ps(_mm_castsi128_ps(hn::VecFromMask(IntTag(), mask).raw)));
  const __m128i picked =
      _mm_loadu_si128(reinterpret_cast<const __m128i*>(picked_bytes[bits].data()));
  return IntVector{_mm_shuffle_epi8(v.raw, picked)};
#else
  return hn::Compress(v, mask);
#endif
}

/// Stores the lanes of the mask and returns their number. May write a whole vector.
HWY_INLINE std::size_t compress_store(IntVector v, hn::Mask<IntTag> mask, std::int32_t* to) {
  hn::StoreU(compress(v, mask), IntTag(), to);
  return hn::CountTrue(IntTag(), mask);
}
HWY_INLINE std::size_t compress_store(FloatVector v, hn::Mask<FloatTag> mask, float* to) {
  const FloatTag d;
  const IntTag di;
  hn::StoreU(hn::BitCast(d, compress(hn::BitCast(di, v), hn::RebindMask(di, mask))), d, to);
  return hn::CountTrue(d, mask);
}

/// Loads x, y and z of points that are records of three or four floats.
template <int floats>
HWY_INLINE void load_points(const float* HWY_RESTRICT points, FloatVector& x, FloatVector& y,
                            FloatVector& z) {
  const FloatTag d;
  if constexpr (floats == 3) {
    hn::LoadInterleaved3(d, points, x, y, z);
  } else {
#if HWY_TARGET <= HWY_AVX3
    // Seven shuffles; LoadInterleaved4 takes fifteen.
    HWY_ALIGN static constexpr std::int32_t x_then_y[] = {0, 4, 8, 12, 16, 20, 24, 28,
                                                          1, 5, 9, 13, 17, 21, 25, 29};
    HWY_ALIGN static constexpr std::int32_t z_twice[] = {2, 6, 10, 14, 18, 22, 26, 30,
                                                         2, 6, 10, 14, 18, 22, 26, 30};
    const __m512i xy = _mm512_load_si512(x_then_y);
    const __m512i zz = _mm512_load_si512(z_twice);
    const __m512 p0 = hn::LoadU(d, points).raw;
    const __m512 p4 = hn::LoadU(d, points + 16).raw;
    const __m512 p8 = hn::LoadU(d, points + 32).raw;
    const __m512 p12 = hn::LoadU(d, points + 48).raw;
    const __m512 xy_0 = _mm512_permutex2var_ps(p0, xy, p4);
    const __m512 xy_8 = _mm512_permutex2var_ps(p8, xy, p12);
    const __m512 z_0 = _mm512_permutex2var_ps(p0, zz, p4);
    const __m512 z_8 = _mm512_permutex2var_ps(p8, zz, p12);
    x = FloatVector{_mm512_shuffle_f32x4(xy_0, xy_8, 0x44)};
    y = FloatVector{_mm512_shuffle_f32x4(xy_0, xy_8, 0xEE)};
    z = FloatVector{_mm512_shuffle_f32x4(z_0, z_8, 0x44)};
#else
    FloatVector unused;
    hn::LoadInterleaved4(d, points, x, y, z, unused);
#endif
  }
}

/// True for points that are not the all-zero missing return. Compares integers without the sign
/// bit, so that denormals are not zero.
HWY_INLINE hn::Mask<FloatTag> is_return(FloatVector x, FloatVector y, FloatVector z) {
  const IntTag di;
  const IntVector bits = hn::BitCast(di, hn::Or(hn::Or(x, y), z));
  return hn::RebindMask(FloatTag(), hn::Ne(hn::ShiftLeft<1>(bits), hn::Zero(di)));
}

/// Vector version of is_valid in point_validity.hpp: all coordinates finite, not all zero.
HWY_INLINE hn::Mask<FloatTag> is_valid(FloatVector x, FloatVector y, FloatVector z) {
  const FloatVector zero = hn::Zero(FloatTag());
  // Infinity * 0 and NaN * 0 are NaN.
  const FloatVector nothing =
      hn::Add(hn::Add(hn::Mul(x, zero), hn::Mul(y, zero)), hn::Mul(z, zero));
  return hn::And(hn::Eq(nothing, zero), is_return(x, y, z));
}

}  // namespace
}  // namespace flagstone::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
