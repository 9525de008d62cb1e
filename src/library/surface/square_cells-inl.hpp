// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
//
// Computes the square cells of a vector of points. Included once for each instruction set.

// clang-format off
#if defined(FLAGSTONE_SURFACE_SQUARE_CELLS_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef FLAGSTONE_SURFACE_SQUARE_CELLS_INL_HPP
#undef FLAGSTONE_SURFACE_SQUARE_CELLS_INL_HPP
#else
#define FLAGSTONE_SURFACE_SQUARE_CELLS_INL_HPP
#endif
// clang-format on

#include "library/core/point_validity.hpp"
#include "library/core/simd/lanes-inl.hpp"
#include "library/surface/square_cells.hpp"

HWY_BEFORE_NAMESPACE();
namespace flagstone::surface::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using namespace flagstone::HWY_NAMESPACE;  // NOLINT(google-build-using-namespace): its other half

HWY_INLINE IntVector all_lanes(std::uint32_t value) {
  return hn::Set(IntTag(), static_cast<std::int32_t>(value));
}

/// Moves bits 0 to 4 to positions 0, 2, 4, 6 and 8.
HWY_INLINE IntVector spread_bits(IntVector v) {
  const IntTag di;
  v = hn::And(hn::Or(v, hn::ShiftLeft<4>(v)), hn::Set(di, 0x10F));
  v = hn::And(hn::Or(v, hn::ShiftLeft<2>(v)), hn::Set(di, 0x133));
  return hn::And(hn::Or(v, hn::ShiftLeft<1>(v)), hn::Set(di, 0x155));
}

/// Number of rings of blocks between the sensor and a column (or row) of blocks.
HWY_INLINE IntVector ring_of(IntVector column, IntVector half) {
  const IntTag di;
  const IntVector from_middle = hn::Sub(column, half);
  return hn::Max(from_middle, hn::Sub(hn::Set(di, -1), from_middle));
}

/// The cells of points within the extent.
HWY_INLINE IntVector cell_of(FloatVector x, FloatVector y, const SquareCells& cells) {
  const FloatTag d;
  const IntTag di;
  // Distance from the edge, in quarters of a metre.
  const FloatVector edge = hn::Set(d, 4 * cells.extent());
  const IntVector qx = whole_part(hn::Add(hn::Mul(x, hn::Set(d, 4.0f)), edge));
  const IntVector qy = whole_part(hn::Add(hn::Mul(y, hn::Set(d, 4.0f)), edge));
  const IntVector column = hn::ShiftRight<5>(qx);
  const IntVector row = hn::ShiftRight<5>(qy);
  const IntVector half = hn::Set(di, cells.half_blocks());
  const IntVector ring =
      hn::Min(hn::Max(ring_of(column, half), ring_of(row, half)), hn::Set(di, 7));

  const IntVector in_block = hn::Set(di, 31);
  const IntVector z_order = hn::Or(spread_bits(hn::And(qx, in_block)),
                                   hn::ShiftLeft<1>(spread_bits(hn::And(qy, in_block))));

  // Computed in floats, because not every instruction set can shift by a different amount per lane.
  // All values are integers below 2^24, so they are exact.
  const FloatVector width = lookup_8(cells.class_widths(), ring);
  const FloatVector per_block = lookup_8(cells.cells_per_block(), ring);
  const FloatVector block =
      hn::Add(hn::Mul(hn::ConvertTo(d, row), width), hn::ConvertTo(d, column));
  const FloatVector first = hn::Add(lookup_8(cells.class_bases(), ring), hn::Mul(per_block, block));
  const FloatVector cells_per_index = hn::Mul(per_block, hn::Set(d, 1.0f / 1024));
  return hn::Add(whole_part(first),
                 whole_part(hn::Mul(hn::ConvertTo(d, z_order), cells_per_index)));
}

/// Whether points are valid and in range.
HWY_INLINE hn::Mask<FloatTag> is_good(FloatVector x, FloatVector y, FloatVector z,
                                      const SquareCells& cells) {
  const FloatTag d;
  const FloatVector squared_range =
      hn::Add(hn::Mul(x, x), hn::Mul(y, y));  // infinite if the square overflows
  const auto in_range = hn::And(hn::Lt(squared_range, hn::Set(d, cells.max_squared_range())),
                                hn::Le(hn::Abs(z), hn::Set(d, max_coordinate)));
  return hn::And(in_range, is_return(x, y, z));
}

/// For each point its cell, noise(), out_of_range() or invalid(). Accepts any value, including NaN,
/// infinity and denormals.
HWY_INLINE IntVector locate(FloatVector x, FloatVector y, FloatVector z, const SquareCells& cells) {
  const FloatTag d;
  const IntTag di;
  const auto good = is_good(x, y, z, cells);
  const FloatVector range = hn::Sqrt(hn::Add(hn::Mul(x, x), hn::Mul(y, y)));
  const FloatVector lowest =
      hn::Sub(hn::Set(d, cells.noise_height()), hn::Mul(hn::Set(d, cells.noise_slope()), range));
  IntVector found = cell_of(hn::IfThenElseZero(good, x), hn::IfThenElseZero(good, y), cells);
  found = hn::IfThenElse(hn::RebindMask(di, hn::Lt(z, lowest)), all_lanes(cells.noise()), found);
  if (HWY_UNLIKELY(!hn::AllTrue(d, good))) {
    const IntVector cellless =
        hn::IfThenElse(hn::RebindMask(di, is_valid(x, y, z)), all_lanes(cells.out_of_range()),
                       all_lanes(cells.invalid()));
    found = hn::IfThenElse(hn::RebindMask(di, good), found, cellless);
  }
  return found;
}

}  // namespace
}  // namespace flagstone::surface::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
