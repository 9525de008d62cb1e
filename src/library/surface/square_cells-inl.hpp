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

#include <algorithm>
#include <limits>

#include "library/core/point_validity.hpp"
#include "library/core/simd/lanes-inl.hpp"
#include "library/surface/packed_points.hpp"
#include "library/surface/square_cells.hpp"

HWY_BEFORE_NAMESPACE();
namespace flagstone::surface::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using namespace flagstone::HWY_NAMESPACE;  // NOLINT(google-build-using-namespace): its other half

struct Located {
  IntVector cell;    ///< or none()
  IntVector packed;  ///< unspecified for none()
  bool all_have_cells;
};

/// Finds the cells of points. Has its own copy of the tables, so that they stay in registers while
/// results are stored.
class CellLocator {
 public:
  HWY_INLINE explicit CellLocator(const SquareCells& cells)
      : half_blocks_(cells.half_blocks()),
        none_(static_cast<std::int32_t>(cells.none())),
        edge_(xy_per_metre * cells.extent()),
        max_squared_range_(cells.max_squared_range()),
        noise_height_(std::max(cells.noise_height(), -max_coordinate)),
        squared_noise_slope_(cells.noise_slope() * cells.noise_slope()),
        rounding_(packed_limit + 0.5f - cells.packed_zero() * z_per_metre),
        bases_(cells.class_bases()),
        strides_(cells.class_strides()),
        shifts_(cells.class_shifts()) {}

  /// The cells of points, and the points in packed form. Accepts any value, including NaN, infinity
  /// and denormals.
  HWY_INLINE Located locate(FloatVector x, FloatVector y, FloatVector z) const {
    const FloatTag d;
    const IntTag di;
    const FloatVector squared_range = hn::Add(hn::Mul(x, x), hn::Mul(y, y));
    // Nearly all vectors have only points that are valid, in range and above all noise.
    auto used = hn::And(
        hn::And(hn::Gt(squared_range, hn::Zero(d)),
                hn::Lt(squared_range, hn::Set(d, max_squared_range_))),
        hn::And(hn::Ge(z, hn::Set(d, noise_height_)), hn::Le(z, hn::Set(d, max_coordinate))));
    bool all_have_cells = hn::AllTrue(d, used);
    if (HWY_UNLIKELY(!all_have_cells)) {
      used = hn::AndNot(is_below_cells(squared_range, z), is_good(squared_range, x, y, z));
      all_have_cells = hn::AllTrue(d, used);
      x = hn::IfThenElseZero(used, x);
      y = hn::IfThenElseZero(used, y);
      z = hn::IfThenElseZero(used, z);
    }
    const IntVector edges = from_edge(x, y);
    IntVector cell = cell_of(edges);
    if (HWY_UNLIKELY(!all_have_cells)) {
      cell = hn::IfThenElse(hn::RebindMask(di, used), cell, hn::Set(di, none_));
    }
    // Without a default constructor: GCC compiles it for any 64-bit Arm, and it cannot call those
    // of vectors.
    return {cell, packed(edges, z), all_have_cells};
  }

  /// Whether points are valid and in range. The squared range is infinite if it overflows.
  HWY_INLINE hn::Mask<FloatTag> is_good(FloatVector squared_range, FloatVector x, FloatVector y,
                                        FloatVector z) const {
    const FloatTag d;
    const auto in_range = hn::And(hn::Lt(squared_range, hn::Set(d, max_squared_range_)),
                                  hn::Le(hn::Abs(z), hn::Set(d, max_coordinate)));
    return hn::And(in_range, is_return(x, y, z));
  }

  /// Whether points are below the noise limit of the cells. For points in range.
  HWY_INLINE hn::Mask<FloatTag> is_below_cells(FloatVector squared_range, FloatVector z) const {
    const FloatTag d;
    const FloatVector depth = hn::Sub(hn::Set(d, noise_height_), z);
    // depth > slope * range, without a square root
    return hn::And(
        hn::Gt(depth, hn::Zero(d)),
        hn::Gt(hn::Mul(depth, depth), hn::Mul(hn::Set(d, squared_noise_slope_), squared_range)));
  }

 private:
  static constexpr float packed_limit = 32768;

  /// Distances from the edge of the cells in units of packed points: x in the lower 16 bits, y in
  /// the upper 16 bits. For points within the extent.
  HWY_INLINE IntVector from_edge(FloatVector x, FloatVector y) const {
    const FloatTag d;
    const FloatVector per_metre = hn::Set(d, xy_per_metre);
    const auto units = [&](FloatVector v) HWY_ATTR {
      return whole_part(hn::Add(hn::Mul(v, per_metre), hn::Set(d, edge_)));
    };
    return hn::Or(units(x), hn::ShiftLeft<16>(units(y)));
  }

  /// Number of rings of blocks between the sensor and a column (or row) of blocks.
  HWY_INLINE IntVector ring_of(IntVector column) const {
    const IntTag di;
    const IntVector from_middle = hn::Sub(column, hn::Set(di, half_blocks_));
    return hn::Max(from_middle, hn::Sub(hn::Set(di, -1), from_middle));
  }

  /// The cell of points from their distances from the edge. x and y are computed at once, each in
  /// 16 bits.
  HWY_INLINE IntVector cell_of(IntVector edges) const {
    const IntTag di;
    // Blocks of 8 m are 2^10 units wide.
    const IntVector block = hn::And(hn::ShiftRight<10>(edges), hn::Set(di, 0x3F003F));
    const IntVector column = hn::And(block, hn::Set(di, 0x3F));
    const IntVector row = hn::ShiftRight<16>(block);
    const IntVector ring = hn::Min(hn::Max(ring_of(column), ring_of(row)), hn::Set(di, 7));

    // The position in the block in cells of 0.25 m, five bits each for x and y, interleaved.
    IntVector bits = hn::And(hn::ShiftRight<5>(edges), hn::Set(di, 0x1F001F));
    bits = hn::And(hn::Or(bits, hn::ShiftLeft<4>(bits)), hn::Set(di, 0x10F010F));
    bits = hn::And(hn::Or(bits, hn::ShiftLeft<2>(bits)), hn::Set(di, 0x1330133));
    bits = hn::And(hn::Or(bits, hn::ShiftLeft<1>(bits)), hn::Set(di, 0x1550155));
    const IntVector z_order = hn::And(hn::Or(bits, hn::ShiftRight<15>(bits)), hn::Set(di, 0x3FF));

    const IntVector first = hn::Add(bases_[ring], sum_of_products(block, strides_[ring]));
    return hn::Add(first, hn::Shr(z_order, shifts_[ring]));
  }

  /// Points in four bytes; see PackedPoint.
  HWY_INLINE IntVector packed(IntVector edges, FloatVector z) const {
    const FloatTag d;
    const IntTag di;
    const FloatVector units = hn::Add(hn::Mul(z, hn::Set(d, z_per_metre)), hn::Set(d, rounding_));
    const IntVector height =
        whole_part(hn::Min(hn::Max(units, hn::Zero(d)), hn::Set(d, 2 * packed_limit - 1)));
    const IntVector in_cell = hn::And(edges, hn::Set(di, 0xFF00FF));
    const IntVector xy = hn::And(hn::Or(in_cell, hn::ShiftRight<8>(in_cell)), hn::Set(di, 0xFFFF));
    // Subtracts the limit from the upper 16 bits.
    return hn::Xor(hn::Or(hn::ShiftLeft<16>(height), xy),
                   hn::Set(di, std::numeric_limits<std::int32_t>::min()));
  }

  std::int32_t half_blocks_;
  std::int32_t none_;
  float edge_;
  float max_squared_range_;
  float noise_height_;
  float squared_noise_slope_;
  float rounding_;  ///< of a packed z
  Table8<IntTag> bases_, strides_, shifts_;
};

}  // namespace
}  // namespace flagstone::surface::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
