// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
//
// The positions of pixels in a RangeImage, for vectors. Included once per instruction set.

// clang-format off
#if defined(FLAGSTONE_MOVING_POINTS_PIXEL_PLACES_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef FLAGSTONE_MOVING_POINTS_PIXEL_PLACES_INL_HPP
#undef FLAGSTONE_MOVING_POINTS_PIXEL_PLACES_INL_HPP
#else
#define FLAGSTONE_MOVING_POINTS_PIXEL_PLACES_INL_HPP
#endif
// clang-format on

#include "library/core/simd/lanes-inl.hpp"
#include "library/moving_points/range_image.hpp"

HWY_BEFORE_NAMESPACE();
namespace flagstone::HWY_NAMESPACE {
namespace {

HWY_INLINE IntVector places_of(const ImageRows& rows, IntVector row, IntVector column) {
  const IntTag di;
  const IntVector above = hn::Sub(row, hn::Set(di, rows.first - ImageRows::empty));
  const IntVector in_memory =
      hn::Max(hn::Min(above, hn::Set(di, rows.in_memory() - 2)), hn::Set(di, 1));
  return hn::Add(hn::Mul(in_memory, hn::Set(di, static_cast<int>(RangeImage::stride))),
                 hn::Add(column, hn::Set(di, 1)));
}

}  // namespace
}  // namespace flagstone::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
