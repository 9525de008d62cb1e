// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "library/core/principal_axes.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "library/core/principal_axes.cpp"
#include <hwy/foreach_target.h>
// The above includes this file once for each instruction set.
#include "library/core/simd/lanes-inl.hpp"
#include "library/core/simd/principal_axes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace flagstone::HWY_NAMESPACE {
namespace {

void axes_of(const Symmetric3& c, double trace, PrincipalAxes& result) {
  const Axes axes = principal_axes(
      {number(c[0]), number(c[1]), number(c[2]), number(c[3]), number(c[4]), number(c[5])},
      number(trace));
  const double spread = hn::GetLane(axes.l1) > 0 ? trace : 0;  // not infinite
  result.eigenvalues = {hn::GetLane(axes.l1) * spread, hn::GetLane(axes.l2) * spread,
                        hn::GetLane(axes.l3) * spread};
  result.normal = {hn::GetLane(axes.normal.x), hn::GetLane(axes.normal.y),
                   hn::GetLane(axes.normal.z)};
}

}  // namespace
}  // namespace flagstone::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace flagstone {
namespace {
HWY_EXPORT(axes_of);
}  // namespace

PrincipalAxes principal_axes(const Symmetric3& covariance) noexcept {
  PrincipalAxes axes{};
  HWY_DYNAMIC_DISPATCH(axes_of)(covariance, covariance[0] + covariance[3] + covariance[5], axes);
  return axes;
}

}  // namespace flagstone
#endif
