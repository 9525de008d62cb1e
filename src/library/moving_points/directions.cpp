// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "library/moving_points/directions.hpp"

#include <numbers>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "library/moving_points/directions.cpp"
#include <hwy/foreach_target.h>
// foreach_target.h includes this file once per instruction set.
#include "library/core/simd/lanes-inl.hpp"

#ifndef FLAGSTONE_MOVING_POINTS_DIRECTIONS_ONCE
#define FLAGSTONE_MOVING_POINTS_DIRECTIONS_ONCE
namespace flagstone {

/// The arrays of Directions.
struct DirectionArrays {
  std::int32_t* rows;
  std::int32_t* columns;
  float* ranges;
  float* elevations;
};

}  // namespace flagstone
#endif

HWY_BEFORE_NAMESPACE();
namespace flagstone::HWY_NAMESPACE {
namespace {

inline constexpr float pi = std::numbers::pi_v<float>;

/// The angle of (x, y) with x >= 0, radians, -pi/2 to pi/2, with an error below 2e-5; 0 for (0, 0).
HWY_INLINE FloatVector right_half_angle(FloatVector x, FloatVector y) {
  const FloatTag d;
  const FloatVector size = hn::Abs(y);
  const auto steep = hn::Gt(size, x);
  const FloatVector smaller = hn::Min(x, size);
  const FloatVector larger = hn::Max(hn::Max(x, size), hn::Set(d, 1e-30F));
  const FloatVector t = hn::Div(smaller, larger);
  const FloatVector s = hn::Mul(t, t);
  // A polynomial for the arc tangent of 0 to 1, with the smallest largest error.
  FloatVector sum = hn::Set(d, -0.01172120F);
  for (const float coefficient :
       {0.05265332F, -0.11643287F, 0.19354346F, -0.33262347F, 0.99997726F}) {
    sum = hn::Add(hn::Mul(sum, s), hn::Set(d, coefficient));
  }
  const FloatVector angle = hn::Mul(t, sum);
  return hn::CopySign(hn::IfThenElse(steep, hn::Sub(hn::Set(d, pi / 2), angle), angle), y);
}

void compute_directions(const PointArrays& points, const AffineTransform& transform,
                        const PixelGrid& grid, const DirectionArrays& to) {
  const FloatTag d;
  const IntTag di;
  const auto coordinate = [&](std::size_t row, FloatVector x, FloatVector y,
                              FloatVector z) HWY_ATTR {
    const float* const m = transform.data() + 4 * row;
    const FloatVector xy = hn::Add(hn::Mul(hn::Set(d, m[0]), x), hn::Mul(hn::Set(d, m[1]), y));
    return hn::Add(hn::Add(xy, hn::Mul(hn::Set(d, m[2]), z)), hn::Set(d, m[3]));
  };
  const FloatVector rows_per_radian = hn::Set(d, grid.rows_per_radian);
  const FloatVector columns_per_radian =
      hn::Set(d, static_cast<float>(PixelGrid::columns) / (2 * pi));
  for (std::size_t k = 0; k < points.size(); k += hn::Lanes(d)) {
    const FloatVector from_x = hn::Load(d, points.x() + k);
    const FloatVector from_y = hn::Load(d, points.y() + k);
    const FloatVector from_z = hn::Load(d, points.z() + k);
    const FloatVector x = coordinate(0, from_x, from_y, from_z);
    const FloatVector y = coordinate(1, from_x, from_y, from_z);
    const FloatVector z = coordinate(2, from_x, from_y, from_z);
    const FloatVector squared = hn::Add(hn::Mul(x, x), hn::Mul(y, y));
    const FloatVector elevation = right_half_angle(hn::Sqrt(squared), z);
    const FloatVector ahead = right_half_angle(hn::Abs(x), y);
    const FloatVector behind = hn::Sub(hn::CopySign(hn::Set(d, pi), y), ahead);
    const FloatVector azimuth = hn::IfThenElse(hn::Lt(x, hn::Zero(d)), behind, ahead);
    const IntVector column =
        hn::ConvertTo(di, hn::Mul(hn::Add(azimuth, hn::Set(d, pi)), columns_per_radian));
    const IntVector last = hn::Set(di, PixelGrid::columns - 1);
    hn::Store(hn::Min(hn::Max(column, hn::Zero(di)), last), di, to.columns + k);
    hn::Store(hn::ConvertTo(di, hn::Floor(hn::Mul(elevation, rows_per_radian))), di, to.rows + k);
    hn::Store(hn::Sqrt(hn::Add(squared, hn::Mul(z, z))), d, to.ranges + k);
    hn::Store(elevation, d, to.elevations + k);
  }
}

}  // namespace
}  // namespace flagstone::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace flagstone {
namespace {
HWY_EXPORT(compute_directions);
}  // namespace

void Directions::compute(const PointArrays& points, const AffineTransform& transform,
                         const PixelGrid& grid) {
  constexpr std::size_t padding = PointArrays::padding;
  const std::size_t padded = (points.size() + padding - 1) / padding * padding;
  rows_.reserve(padded);
  columns_.reserve(padded);
  ranges_.reserve(padded);
  elevations_.reserve(padded);
  HWY_DYNAMIC_DISPATCH(compute_directions)
  (points, transform, grid,
   {.rows = rows_.data(),
    .columns = columns_.data(),
    .ranges = ranges_.data(),
    .elevations = elevations_.data()});
}

}  // namespace flagstone
#endif
