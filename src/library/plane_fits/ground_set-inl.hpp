// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
//
// Tests whether points belong to a ground set, eqs. (5) and (6). Included once per instruction set.

// clang-format off
#if defined(FLAGSTONE_PLANE_FITS_GROUND_SET_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef FLAGSTONE_PLANE_FITS_GROUND_SET_INL_HPP
#undef FLAGSTONE_PLANE_FITS_GROUND_SET_INL_HPP
#else
#define FLAGSTONE_PLANE_FITS_GROUND_SET_INL_HPP
#endif
// clang-format on

#include "library/core/simd/lanes-inl.hpp"
#include "library/plane_fits/ground_sets.hpp"

HWY_BEFORE_NAMESPACE();
namespace flagstone::plane_fits::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using namespace flagstone::HWY_NAMESPACE;  // NOLINT(google-build-using-namespace): its other half

/// n . p for vectors of any length.
template <class D>
HWY_INLINE hn::Vec<D> height(D d, hn::Vec<D> x, hn::Vec<D> y, hn::Vec<D> z, const GroundSet& set) {
  return hn::Add(
      hn::Add(hn::Mul(hn::Set(d, set.normal_x), x), hn::Mul(hn::Set(d, set.normal_y), y)),
      hn::Mul(hn::Set(d, set.normal_z), z));
}

/// bottom <= n . p < top
template <class D>
HWY_INLINE hn::Mask<D> in_set(D d, hn::Vec<D> x, hn::Vec<D> y, hn::Vec<D> z, const GroundSet& set) {
  const auto h = height(d, x, y, z, set);
  return hn::And(hn::Lt(h, hn::Set(d, set.top)), hn::Ge(h, hn::Set(d, set.bottom)));
}

}  // namespace
}  // namespace flagstone::plane_fits::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
