// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
//
// Reads the points of a cloud in any layout, one vector at a time. Included once per instruction
// set.

// clang-format off
#if defined(FLAGSTONE_CORE_SIMD_READ_CLOUD_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef FLAGSTONE_CORE_SIMD_READ_CLOUD_INL_HPP
#undef FLAGSTONE_CORE_SIMD_READ_CLOUD_INL_HPP
#else
#define FLAGSTONE_CORE_SIMD_READ_CLOUD_INL_HPP
#endif
// clang-format on

#include <hwy/cache_control.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

#include "flagstone/cloud_view.hpp"
#include "library/core/simd/lanes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace flagstone::HWY_NAMESPACE {
namespace {

/// Prefetch distance in floats. The time per block is so long that the hardware prefetcher of the
/// CPU is too late for scans that are not in the cache.
inline constexpr std::size_t cloud_prefetch_distance = 1024;

/// Prefetches a later block. Addresses after the end of the cloud do no harm.
template <std::size_t floats>
HWY_INLINE void prefetch_block(const float* points) {
  for (std::size_t line = 0; line < floats; ++line) {  // a cache line is 16 floats
    hwy::Prefetch(points + cloud_prefetch_distance + lanes * line);
  }
}

/// Reads sixteen points of `floats` floats each.
template <std::size_t floats, class Work>
HWY_INLINE void read_block(const float* HWY_RESTRICT points, std::size_t index, Work&& work) {
  const FloatTag d;
  for (std::size_t lane = 0; lane < lanes; lane += hn::Lanes(d)) {
    FloatVector x, y, z;
    load_points<floats>(points + floats * lane, x, y, z);
    work(index + lane, x, y, z);
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

/// Calls `work(i, x, y, z)` for the points `begin` + i, one vector after another, up to the end of
/// the block of sixteen that contains point `end` - 1. Coordinates can have any value, including
/// NaN, infinity and denormals; points at `end` or later have unspecified coordinates. `work`
/// should be a struct whose operator() is HWY_INLINE, so that its tables stay in registers.
///
/// Packed xyz and records of four floats are read without copying, except for the last points of
/// the cloud, where a read could leave it. All other layouts are copied first.
template <class Work>
HWY_INLINE void read_cloud(const CloudView& cloud, std::size_t begin, std::size_t end,
                           Work&& work) {
  const CloudLayout& layout = cloud.layout();
  const std::byte* first = static_cast<const std::byte*>(cloud.data()) + layout.x +
                           static_cast<std::ptrdiff_t>(begin) * layout.stride;
  const auto* floats = reinterpret_cast<const float*>(first);
  const bool together = layout.y == layout.x + 4 && layout.z == layout.x + 8 && layout.stride >= 12;
  const bool aligned = std::bit_cast<std::uintptr_t>(first) % sizeof(float) == 0;
  const std::size_t count = end - begin;
  // Number of points in blocks that do not contain the last point of the cloud.
  const std::size_t whole =
      together ? (std::min(end, cloud.size() - 1) - begin) / lanes * lanes : 0;

  HWY_ALIGN std::array<float, 4 * lanes> records{};
  std::size_t i = 0;
  if (aligned && layout.stride == 16) {
    for (; i < whole; i += lanes) {
      prefetch_block<4>(floats + 4 * i);
      read_block<4>(floats + 4 * i, i, work);
    }
  } else if (aligned && layout.stride == 12) {
    for (; i < whole; i += lanes) {
      prefetch_block<3>(floats + 3 * i);
      read_block<3>(floats + 3 * i, i, work);
    }
  }
  for (; i < whole; i += lanes) {
    copy_records_at_once(first + static_cast<std::ptrdiff_t>(i) * layout.stride, layout.stride,
                         records.data());
    read_block<4>(records.data(), i, work);
  }
  for (; i < count; i += lanes) {
    copy_records(cloud, begin + i, begin + std::min(count, i + lanes), records.data());
    read_block<4>(records.data(), i, work);
  }
}

}  // namespace
}  // namespace flagstone::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
