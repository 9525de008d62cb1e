// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
//
// The only pass over a cloud. It copies the coordinates and records where the bin changes from one
// point to the next, for any function that finds the bin of a point. Included once per instruction
// set.

// clang-format off
#if defined(FLAGSTONE_PLANE_FITS_READ_STRETCH_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef FLAGSTONE_PLANE_FITS_READ_STRETCH_INL_HPP
#undef FLAGSTONE_PLANE_FITS_READ_STRETCH_INL_HPP
#else
#define FLAGSTONE_PLANE_FITS_READ_STRETCH_INL_HPP
#endif
// clang-format on

#include <hwy/cache_control.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

#include "library/core/simd/lanes-inl.hpp"
#include "library/plane_fits/scan_points.hpp"

HWY_BEFORE_NAMESPACE();
namespace flagstone::plane_fits::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using namespace flagstone::HWY_NAMESPACE;  // NOLINT(google-build-using-namespace): its other half

/// Records the points at which the bin changes.
class RunWriter {
 public:
  RunWriter(RunStart* starts) : begin_(starts), end_(starts) {}

  /// Adds the bins of the next vector of points.
  HWY_INLINE void add(IntVector bins) {
    const IntTag di;
    const auto starts = hn::Ne(bins, move_up(bins, previous_));
    end_ += compress_store(hn::Or(bins, places_), starts, reinterpret_cast<std::int32_t*>(end_));
    previous_ = bins;
    places_ = hn::Add(places_, hn::Set(di, static_cast<std::int32_t>(hn::Lanes(di)) << bin_bits));
  }

  /// Removes runs that begin at `count` or later, closes the list and returns the number of runs.
  std::size_t close(std::size_t count) {
    while (end_ > begin_ && (end_[-1] >> bin_bits) >= count) --end_;
    *end_ = static_cast<RunStart>(count) << bin_bits;
    return static_cast<std::size_t>(end_ - begin_);
  }

 private:
  RunStart* begin_;
  RunStart* end_;
  IntVector previous_ = hn::Set(IntTag(), -1);  // not a bin
  /// Indices of the next points, shifted left by bin_bits.
  IntVector places_ = hn::ShiftLeft<bin_bits>(hn::Iota(IntTag(), 0));
};

/// Prefetch distance in floats. The time per block is so long that the hardware prefetcher of the
/// CPU is too late for scans that are not in the cache.
inline constexpr std::size_t prefetch_distance = 512;

/// Prefetches a later block. Addresses after the end of the cloud do no harm.
template <std::size_t floats>
HWY_INLINE void prefetch_block(const float* points) {
  for (std::size_t line = 0; line < floats; ++line) {  // a cache line is 16 floats
    hwy::Prefetch(points + prefetch_distance + lanes * line);
  }
}

/// Reads sixteen points of `floats` floats each and finds their bins.
template <std::size_t floats, class Locate>
HWY_INLINE void read_block(const float* HWY_RESTRICT points, std::size_t index,
                           const PointSlice& slice, const Locate& locate, RunWriter& runs) {
  const FloatTag d;
  for (std::size_t lane = 0; lane < lanes; lane += hn::Lanes(d)) {
    FloatVector x, y, z;
    load_points<floats>(points + floats * lane, x, y, z);
    hn::StoreU(x, d, slice.x + index + lane);
    hn::StoreU(y, d, slice.y + index + lane);
    hn::StoreU(z, d, slice.z + index + lane);
    runs.add(locate(x, y, z));
  }
}

/// Copies points into records of four floats. The fourth float is not set.
HWY_INLINE void copy_records(const CloudView& cloud, std::size_t begin, std::size_t end,
                             float* records) {
  for (std::size_t k = begin; k < end; ++k) {
    const Point p = cloud[k];
    std::memcpy(records + 4 * (k - begin), &p, sizeof p);
  }
}

/// Copies sixteen points into records of four floats, if x, y and z are adjacent and four more
/// bytes can be read after z.
HWY_INLINE void copy_records_at_once(const std::byte* points, std::ptrdiff_t stride,
                                     float* records) {
  for (std::size_t k = 0; k < lanes; ++k) {
    std::memcpy(records + 4 * k, points + static_cast<std::ptrdiff_t>(k) * stride,
                4 * sizeof(float));
  }
}

/// Reads a slice and returns its number of runs. `locate(x, y, z)` returns the bins of a vector of
/// points, each less than 1 << bin_bits, for coordinates of any value, including NaN, infinity and
/// denormals. It should be a struct whose operator() is HWY_INLINE, so that its tables stay in
/// registers.
///
/// Packed xyz and records of four floats are read without copying, except for the last points of
/// the cloud, where a read could leave it. All other layouts are copied first.
template <class Locate>
HWY_INLINE std::size_t read_slice(const PointSlice& slice, const Locate& locate) {
  const CloudView& cloud = slice.cloud;
  const CloudLayout& layout = cloud.layout();
  const std::byte* first = static_cast<const std::byte*>(cloud.data()) + layout.x +
                           static_cast<std::ptrdiff_t>(slice.begin) * layout.stride;
  const auto* floats = reinterpret_cast<const float*>(first);
  const bool together = layout.y == layout.x + 4 && layout.z == layout.x + 8 && layout.stride >= 12;
  const bool aligned = std::bit_cast<std::uintptr_t>(first) % sizeof(float) == 0;
  const std::size_t count = slice.end - slice.begin;
  // Number of points in blocks that do not contain the last point of the cloud.
  const std::size_t whole =
      together ? (std::min(slice.end, cloud.size() - 1) - slice.begin) / lanes * lanes : 0;

  RunWriter runs(slice.starts);
  HWY_ALIGN std::array<float, 4 * lanes> records{};
  std::size_t i = 0;
  if (aligned && layout.stride == 16) {
    for (; i < whole; i += lanes) {
      prefetch_block<4>(floats + 4 * i);
      read_block<4>(floats + 4 * i, i, slice, locate, runs);
    }
  } else if (aligned && layout.stride == 12) {
    for (; i < whole; i += lanes) {
      prefetch_block<3>(floats + 3 * i);
      read_block<3>(floats + 3 * i, i, slice, locate, runs);
    }
  }
  for (; i < whole; i += lanes) {
    copy_records_at_once(first + static_cast<std::ptrdiff_t>(i) * layout.stride, layout.stride,
                         records.data());
    read_block<4>(records.data(), i, slice, locate, runs);
  }
  for (; i < count; i += lanes) {
    copy_records(cloud, slice.begin + i, slice.begin + std::min(count, i + lanes), records.data());
    read_block<4>(records.data(), i, slice, locate, runs);
  }
  return runs.close(count);
}

}  // namespace
}  // namespace flagstone::plane_fits::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
