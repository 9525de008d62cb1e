// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "library/core/plane.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "library/core/plane.cpp"
#include <hwy/foreach_target.h>
// foreach_target.h includes this file once per instruction set.
#include "library/core/simd/lanes-inl.hpp"
#include "library/core/simd/principal_axes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace flagstone::HWY_NAMESPACE {
namespace {

void axes_of(const Symmetric3& c, double trace, PrincipalAxes& result) {
  const Axes axes = principal_axes(
      {number(c[0]), number(c[1]), number(c[2]), number(c[3]), number(c[4]), number(c[5])},
      number(trace));
  const double spread = hn::GetLane(axes.l1) > 0 ? trace : 0;  // avoids infinity
  result.eigenvalues = {hn::GetLane(axes.l1) * spread, hn::GetLane(axes.l2) * spread,
                        hn::GetLane(axes.l3) * spread};
  result.normal = {hn::GetLane(axes.normal.x), hn::GetLane(axes.normal.y),
                   hn::GetLane(axes.normal.z)};
}

/// Fits one plane per lane, starting with plane `first`. Returns bits as fit_planes does.
HWY_INLINE std::uint32_t fit(const MomentsBatch& moments, std::size_t first, PlaneBatch& planes) {
  const DoubleTag d;
  const auto load = [&](const Batch& batch) HWY_ATTR { return hn::Load(d, batch.data() + first); };
  const auto store = [&](DoubleVector v, Batch& batch)
                         HWY_ATTR { hn::Store(v, d, batch.data() + first); };

  const DoubleVector n = load(moments.count);
  const DoubleMask exists = hn::Ge(n, number(3));
  const DoubleVector count = hn::IfThenElse(exists, n, number(3));

  // Mean and covariance as in Moments::mean() and Moments::covariance().
  const std::array<DoubleVector, 3> sum = {load(moments.sum[0]), load(moments.sum[1]),
                                           load(moments.sum[2])};
  const Vectors3 mean = {div(sum[0], count), div(sum[1], count), div(sum[2], count)};
  const DoubleVector degrees = sub(count, number(1));
  const auto covariance = [&](std::size_t entry, DoubleVector a, DoubleVector b) HWY_ATTR {
    return div(sub(load(moments.squares[entry]), mul(a, b)), degrees);
  };
  const Symmetrics c = {covariance(0, sum[0], mean.x), covariance(1, sum[0], mean.y),
                        covariance(2, sum[0], mean.z), covariance(3, sum[1], mean.y),
                        covariance(4, sum[1], mean.z), covariance(5, sum[2], mean.z)};
  // If all points are equal, rounding may make the trace negative.
  const DoubleVector trace = hn::Max(add(add(c.xx, c.yy), c.zz), number(0));
  const Axes axes = principal_axes(c, trace);
  const Vectors3& normal = axes.normal;
  store(n, planes.count);
  store(mean.x, planes.mean[0]);
  store(mean.y, planes.mean[1]);
  store(mean.z, planes.mean[2]);
  store(normal.x, planes.normal[0]);
  store(normal.y, planes.normal[1]);
  store(normal.z, planes.normal[2]);
  store(hn::Neg(add(add(mul(normal.x, mean.x), mul(normal.y, mean.y)), mul(normal.z, mean.z))),
        planes.d);
  store(mul(axes.l1, trace), planes.eigenvalues[0]);  // a trace of float sums is finite
  store(mul(axes.l2, trace), planes.eigenvalues[1]);
  store(mul(axes.l3, trace), planes.eigenvalues[2]);

  // A relative error of 1e-6 in the sums of squares rotates the normal by that error divided by the
  // gap between the two smaller eigenvalues.
  const DoubleVector squares =
      add(add(load(moments.squares[0]), load(moments.squares[3])), load(moments.squares[5]));
  const DoubleMask centered = hn::Gt(mul(mul(trace, count), number(8)), squares);
  const DoubleMask distinct = hn::Gt(sub(axes.l2, axes.l3), number(0.01));
  const DoubleMask doubtful = hn::AndNot(hn::And(centered, distinct), exists);
  HWY_ALIGN std::array<std::uint8_t, 8> bits{};
  hn::StoreMaskBits(d, doubtful, bits.data());
  return static_cast<std::uint32_t>(bits[0]) << first;
}

std::uint32_t fit_all(const MomentsBatch& moments, PlaneBatch& planes) {
  std::uint32_t doubtful = 0;
  for (std::size_t i = 0; i < batch_size; i += hn::Lanes(DoubleTag())) {
    doubtful |= fit(moments, i, planes);
  }
  return doubtful;
}

}  // namespace
}  // namespace flagstone::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace flagstone {
namespace {
HWY_EXPORT(axes_of);
HWY_EXPORT(fit_all);
}  // namespace

PrincipalAxes principal_axes(const Symmetric3& covariance) noexcept {
  PrincipalAxes axes{};
  HWY_DYNAMIC_DISPATCH(axes_of)(covariance, covariance[0] + covariance[3] + covariance[5], axes);
  return axes;
}

std::uint32_t fit_planes(const MomentsBatch& moments, PlaneBatch& planes) noexcept {
  return HWY_DYNAMIC_DISPATCH(fit_all)(moments, planes);
}

Plane PlaneBatch::operator[](std::size_t i) const noexcept {
  return {.count = count[i],
          .mean = {mean[0][i], mean[1][i], mean[2][i]},
          .normal = {normal[0][i], normal[1][i], normal[2][i]},
          .d = d[i],
          .eigenvalues = {eigenvalues[0][i], eigenvalues[1][i], eigenvalues[2][i]}};
}

Plane Plane::moved_by(const Vector3& origin) const noexcept {
  Plane moved = *this;
  for (std::size_t k = 0; k < 3; ++k) {
    moved.mean[k] += origin[k];
    moved.d -= normal[k] * origin[k];
  }
  return moved;
}

void set_plane(const Plane& plane, Patch& patch) noexcept {
  const auto to_floats = [](const Vector3& v) {
    return std::array{static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2])};
  };
  patch.mean = to_floats(plane.mean);
  patch.normal = to_floats(plane.normal);
  patch.d = static_cast<float>(plane.d);
  patch.eigenvalues = to_floats(plane.eigenvalues);
}

Plane plane_of(const Moments& moments) noexcept {
  if (moments.count < 3) return {};
  const PrincipalAxes axes = principal_axes(moments.covariance());
  const Vector3 mean = moments.mean();
  const Vector3& n = axes.normal;
  return {.count = moments.count,
          .mean = mean,
          .normal = n,
          .d = -(n[0] * mean[0] + n[1] * mean[1] + n[2] * mean[2]),
          .eigenvalues = axes.eigenvalues};
}

}  // namespace flagstone
#endif
