// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "library/plane_fits/moved_points.hpp"

#include <cstddef>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "library/plane_fits/moved_points.cpp"
#include <hwy/foreach_target.h>
// The above includes this file once for each instruction set.
#include "library/core/simd/lanes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace flagstone::plane_fits::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

/// Eight points a step, the rest of a step being overwritten by the next run: most runs within a
/// small cell take one step, and so no mispredicted branch.
void move_runs(const ScanPoints& scan, std::span<const Run> runs, MovedPoint* points) {
  constexpr std::size_t step = 8;
  const hn::CappedTag<float, step> d;
  const hn::RebindToSigned<decltype(d)> di;
  const float* HWY_RESTRICT from_x = scan.x();
  const float* HWY_RESTRICT from_y = scan.y();
  const float* HWY_RESTRICT from_z = scan.z();
  const auto places = hn::Iota(di, 0);
  auto* HWY_RESTRICT to = reinterpret_cast<float*>(points);
  for (const Run& run : runs) {
    std::size_t i = 0;
    do {
      for (std::size_t lane = 0; lane < step; lane += hn::Lanes(d)) {
        const std::size_t from = run.begin + i + lane;
        const auto index = hn::Add(hn::Set(di, static_cast<std::int32_t>(from)), places);
        hn::StoreInterleaved4(hn::LoadU(d, from_x + from), hn::LoadU(d, from_y + from),
                              hn::LoadU(d, from_z + from), hn::BitCast(d, index), d,
                              to + 4 * (i + lane));
      }
      i += step;
    } while (i < run.length);
    to += 4 * std::size_t{run.length};
  }
}

}  // namespace
}  // namespace flagstone::plane_fits::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace flagstone::plane_fits {
namespace {
HWY_EXPORT(move_runs);
}  // namespace

void move_points(const ScanPoints& scan, std::span<const Run> runs, MovedPoint* points) noexcept {
  HWY_DYNAMIC_DISPATCH(move_runs)(scan, runs, points);
}

}  // namespace flagstone::plane_fits
#endif
