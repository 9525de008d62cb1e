// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
//
// Samples of packed points that depend on the set of points, but not on their order. Included once
// for each instruction set.

// clang-format off
#if defined(FLAGSTONE_SURFACE_CONTENT_SAMPLE_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef FLAGSTONE_SURFACE_CONTENT_SAMPLE_INL_HPP
#undef FLAGSTONE_SURFACE_CONTENT_SAMPLE_INL_HPP
#else
#define FLAGSTONE_SURFACE_CONTENT_SAMPLE_INL_HPP
#endif
// clang-format on

#include <cstddef>
#include <cstdint>

#include "library/core/simd/lanes-inl.hpp"
#include "library/surface/packed_points.hpp"

HWY_BEFORE_NAMESPACE();
namespace flagstone::surface::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using namespace flagstone::HWY_NAMESPACE;  // NOLINT(google-build-using-namespace): its other half

/// Two independent hashes: factors of (x, y) as one integer of 16 bits, and of z.
inline constexpr std::int32_t cell_hash = 0x6C4F | 0x5A7B << 16;
inline constexpr std::int32_t patch_hash = 0x4E35 | 0x79B5 << 16;

/// A hash of each point, 0 to 65,535.
HWY_INLINE IntVector hash_of(IntVector points, std::int32_t factors) {
  const IntTag di;
  return hn::And(sum_of_products(points, hn::Set(di, factors)), hn::Set(di, 0xFFFF));
}

/// How large a sample is.
struct SampleSize {
  std::uint32_t most;    ///< maximum number of points
  std::uint32_t wanted;  ///< expected number of points if there are more than `most`
};

/// A point belongs to the sample if its hash is below the returned threshold. Points that are
/// equal are taken or left together.
///
/// The first threshold selects `wanted` points on average. It is reduced by a quarter until the
/// sample is small enough.
HWY_INLINE std::int32_t sample_threshold(const PackedPoint* points, std::size_t count,
                                         SampleSize size, std::int32_t factors) {
  const IntTag di;
  auto threshold = static_cast<std::uint32_t>((std::uint64_t{size.wanted} << 16U) / count);
  const auto* HWY_RESTRICT from = reinterpret_cast<const std::int32_t*>(points);
  for (; threshold > 0; threshold = threshold * 3 / 4) {
    const IntVector limit = hn::Set(di, static_cast<std::int32_t>(threshold));
    std::size_t sampled = 0;
    std::size_t i = 0;
    for (; i + hn::Lanes(di) <= count; i += hn::Lanes(di)) {
      sampled += hn::CountTrue(di, hn::Lt(hash_of(hn::LoadU(di, from + i), factors), limit));
    }
    if (i < count) {
      const auto there = hn::FirstN(di, count - i);
      const IntVector hash = hash_of(hn::LoadU(di, from + i), factors);
      sampled += hn::CountTrue(di, hn::And(there, hn::Lt(hash, limit)));
    }
    if (sampled <= size.most) break;
  }
  return static_cast<std::int32_t>(threshold);
}

/// Copies the points whose hash is below the threshold and returns their number, or a number above
/// `most` as soon as there are more. Can write 48 elements more than `most`.
HWY_INLINE std::size_t copy_sample(const PackedPoint* points, std::size_t count,
                                   std::int32_t threshold, std::int32_t factors, std::size_t most,
                                   PackedPoint* sample) {
  const IntTag di;
  const IntVector limit = hn::Set(di, threshold);
  const auto* HWY_RESTRICT from = reinterpret_cast<const std::int32_t*>(points);
  auto* const to = reinterpret_cast<std::int32_t*>(sample);
  std::size_t sampled = 0;
  std::size_t i = 0;
  for (; i + hn::Lanes(di) <= count && sampled <= most; i += hn::Lanes(di)) {
    const IntVector v = hn::LoadU(di, from + i);
    sampled += compress_store(v, hn::Lt(hash_of(v, factors), limit), to + sampled);
  }
  if (i < count && sampled <= most) {
    const IntVector v = hn::LoadU(di, from + i);
    const auto there = hn::FirstN(di, count - i);
    sampled += compress_store(v, hn::And(there, hn::Lt(hash_of(v, factors), limit)), to + sampled);
  }
  return sampled;
}

/// Copies a sample of the points and returns its size. Can write 48 elements more than `size.most`.
/// The thresholds are those of sample_threshold(), but most samples are taken in one pass.
HWY_INLINE std::size_t take_sample(const PackedPoint* points, std::size_t count, SampleSize size,
                                   PackedPoint* sample) {
  auto threshold = static_cast<std::uint32_t>((std::uint64_t{size.wanted} << 16U) / count);
  for (; threshold > 0; threshold = threshold * 3 / 4) {
    const std::size_t sampled = copy_sample(points, count, static_cast<std::int32_t>(threshold),
                                            cell_hash, size.most, sample);
    if (sampled <= size.most) return sampled;
  }
  return 0;
}

}  // namespace
}  // namespace flagstone::surface::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
