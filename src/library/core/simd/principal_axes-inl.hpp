// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
//
// Principal component analysis of 3 x 3 covariances, eq. (4), one per lane. Included once per
// instruction set. Uses only + - * / and square root, which round identically everywhere.

// clang-format off
#if defined(FLAGSTONE_CORE_SIMD_PRINCIPAL_AXES_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef FLAGSTONE_CORE_SIMD_PRINCIPAL_AXES_INL_HPP
#undef FLAGSTONE_CORE_SIMD_PRINCIPAL_AXES_INL_HPP
#else
#define FLAGSTONE_CORE_SIMD_PRINCIPAL_AXES_INL_HPP
#endif
// clang-format on

#include "library/core/simd/lanes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace flagstone::HWY_NAMESPACE {
namespace {

using DoubleMask = hn::Mask<DoubleTag>;

/// Short names for operations on vectors of doubles.
HWY_INLINE DoubleVector number(double value) { return hn::Set(DoubleTag(), value); }
HWY_INLINE DoubleVector add(DoubleVector a, DoubleVector b) { return hn::Add(a, b); }
HWY_INLINE DoubleVector sub(DoubleVector a, DoubleVector b) { return hn::Sub(a, b); }
HWY_INLINE DoubleVector mul(DoubleVector a, DoubleVector b) { return hn::Mul(a, b); }
HWY_INLINE DoubleVector div(DoubleVector a, DoubleVector b) { return hn::Div(a, b); }

/// a b - c d
HWY_INLINE DoubleVector minor(DoubleVector a, DoubleVector b, DoubleVector c, DoubleVector d) {
  return sub(mul(a, b), mul(c, d));
}

struct Vectors3 {
  DoubleVector x, y, z;
};

/// Entries of symmetric matrices.
struct Symmetrics {
  DoubleVector xx, xy, xz, yy, yz, zz;
};

HWY_INLINE Vectors3 cross(const Vectors3& a, const Vectors3& b) {
  return {minor(a.y, b.z, a.z, b.y), minor(a.z, b.x, a.x, b.z), minor(a.x, b.y, a.y, b.x)};
}

HWY_INLINE DoubleVector squared_length(const Vectors3& v) {
  return add(add(mul(v.x, v.x), mul(v.y, v.y)), mul(v.z, v.z));
}

HWY_INLINE Vectors3 select(DoubleMask mask, const Vectors3& yes, const Vectors3& no) {
  return {hn::IfThenElse(mask, yes.x, no.x), hn::IfThenElse(mask, yes.y, no.y),
          hn::IfThenElse(mask, yes.z, no.z)};
}

HWY_INLINE Vectors3 longer(const Vectors3& a, const Vectors3& b) {
  return select(hn::Gt(squared_length(b), squared_length(a)), b, a);
}

/// Scales to unit length and makes z positive. If z is within 1e-6 of 0, rounding would decide the
/// sign: z is then set to 0, and the larger of x and y is made positive.
HWY_INLINE Vectors3 unit_upward(const Vectors3& v) {
  const DoubleVector length = hn::Sqrt(squared_length(v));
  const DoubleMask level = hn::Le(hn::Abs(v.z), mul(number(1e-6), length));
  const DoubleVector larger = hn::IfThenElse(hn::Gt(hn::Abs(v.y), hn::Abs(v.x)), v.y, v.x);
  const DoubleVector up = hn::IfThenElse(level, larger, v.z);
  const DoubleVector scale =
      div(hn::IfThenElse(hn::Lt(up, number(0)), number(-1), number(1)), length);
  return {mul(v.x, scale), mul(v.y, scale), hn::IfThenElse(level, number(0), mul(v.z, scale))};
}

/// Smallest root of lambda^3 - lambda^2 + c1 lambda - c0, which has three roots in [0, 1]; 0 in
/// lanes that are not `wanted`. Left of the roots the polynomial is negative, increasing and
/// concave, so Newton's method converges from 0 with increasing values, quadratically.
HWY_INLINE DoubleVector smallest_root(DoubleVector c1, DoubleVector c0, DoubleMask wanted) {
  const DoubleTag d;
  DoubleVector root = hn::Zero(d);
  DoubleMask moving = wanted;
  for (int i = 0; i < 60; ++i) {  // one or two dozen are needed only if two roots are equal
    const DoubleVector value = sub(mul(add(mul(sub(root, number(1)), root), c1), root), c0);
    const DoubleVector slope = add(mul(sub(mul(number(3), root), number(2)), root), c1);
    const DoubleVector step = div(value, slope);  // negative
    moving = hn::And(hn::And(moving, hn::Lt(value, number(0))), hn::Gt(slope, number(0)));
    root = hn::IfThenElse(moving, sub(root, step), root);
    moving = hn::And(moving, hn::Lt(step, number(-1e-9)));
    if (hn::AllFalse(d, moving)) break;
  }
  return root;
}

HWY_INLINE Vectors3 most_upright_normal_of_line(const Vectors3& direction) {
  const Vectors3 along = unit_upward(direction);
  const Vectors3 upright = {hn::Neg(mul(along.z, along.x)), hn::Neg(mul(along.z, along.y)),
                            sub(number(1), mul(along.z, along.z))};
  const DoubleMask vertical = hn::Lt(squared_length(upright), number(1e-10));
  return select(vertical, {number(1), number(0), number(0)}, unit_upward(upright));
}

struct Axes {
  DoubleVector l1, l2, l3;  ///< eigenvalues divided by their sum, descending
  Vectors3 normal;
};

/// See plane.hpp. Eigenvalues are divided by `trace`; they are 0 if it is not positive and finite.
HWY_INLINE Axes principal_axes(const Symmetrics& c, DoubleVector trace) {
  // Eigenvalues count as equal if their difference, divided by their sum, is smaller than this. It
  // is large enough that rounding (1e-16 of a determinant, divided by lambda_2) has no influence.
  const DoubleVector equal_share = number(1e-6);

  // Scale to trace 1.
  const DoubleVector xx = div(c.xx, trace);
  const DoubleVector xy = div(c.xy, trace);
  const DoubleVector xz = div(c.xz, trace);
  const DoubleVector yy = div(c.yy, trace);
  const DoubleVector yz = div(c.yz, trace);
  const DoubleVector zz = div(c.zz, trace);
  const DoubleVector minors =
      add(add(minor(xx, yy, xy, xy), minor(xx, zz, xz, xz)), minor(yy, zz, yz, yz));
  const DoubleVector determinant =
      add(sub(mul(xx, minor(yy, zz, yz, yz)), mul(xy, minor(xy, zz, yz, xz))),
          mul(xz, minor(xy, yz, yy, xz)));

  // The minors are about lambda_2 + lambda_3. Smaller values are rounding errors: points on a line.
  const DoubleMask on_a_plane = hn::Gt(minors, equal_share);
  const DoubleVector l3 = smallest_root(minors, determinant, on_a_plane);
  const DoubleVector rest = sub(number(1), l3);             // lambda_1 + lambda_2
  const DoubleVector product = sub(minors, mul(l3, rest));  // lambda_1 * lambda_2
  const DoubleVector gap =
      hn::Sqrt(hn::Max(sub(mul(rest, rest), mul(number(4), product)), number(0)));
  const DoubleVector l1 = mul(add(rest, gap), number(0.5));
  const DoubleVector l2 = hn::Max(mul(sub(rest, gap), number(0.5)), l3);

  // The rows of C - lambda_3 I span the plane orthogonal to the normal.
  const Vectors3 r0 = {sub(xx, l3), xy, xz};
  const Vectors3 r1 = {xy, sub(yy, l3), yz};
  const Vectors3 r2 = {xz, yz, sub(zz, l3)};
  const Vectors3 across = unit_upward(longer(longer(cross(r0, r1), cross(r0, r2)), cross(r1, r2)));

  const DoubleMask has_spread = hn::And(hn::Gt(trace, number(0)), hn::Lt(trace, number(1e300)));
  const DoubleMask has_plane = hn::And(has_spread, hn::Gt(sub(l2, l3), equal_share));
  const DoubleMask has_line = hn::And(has_spread, hn::Gt(sub(l1, l3), equal_share));
  Vectors3 normal = {number(0), number(0), number(1)};
  if (!hn::AllTrue(DoubleTag(), has_plane)) {
    normal = select(has_line, most_upright_normal_of_line(longer(longer(r0, r1), r2)), normal);
  }
  return {hn::IfThenElseZero(has_spread, l1), hn::IfThenElseZero(has_spread, l2),
          hn::IfThenElseZero(has_spread, l3), select(has_plane, across, normal)};
}

}  // namespace
}  // namespace flagstone::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
