// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "core/principal_axes.hpp"

#include <cmath>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/principal_axes.cpp"
#include <hwy/foreach_target.h>
// The above includes this file once for each instruction set.
#include "core/simd/lanes-inl.hpp"
#include "core/simd/principal_axes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace flagstone::HWY_NAMESPACE {
namespace {

void axes_of(const Symmetric3& c, double trace, PrincipalAxes& result) {
  const Axes axes = principal_axes({number(c[0]), number(c[1]), number(c[2]), number(c[3]),
                                    number(c[4]), number(c[5])},
                                   number(trace));
  result.eigenvalues = {hn::GetLane(axes.l1) * trace, hn::GetLane(axes.l2) * trace,
                        hn::GetLane(axes.l3) * trace};
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
  const double trace = covariance[0] + covariance[3] + covariance[5];
  PrincipalAxes axes{{0, 0, 0}, {0, 0, 1}};
  if (trace > 0 && std::isfinite(trace)) {
    HWY_DYNAMIC_DISPATCH(axes_of)(covariance, trace, axes);
  }
  return axes;
}

}  // namespace flagstone
#endif
