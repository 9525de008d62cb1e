// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace flagstone {

/// Rotation matrix, row by row.
using RotationMatrix = std::array<double, 9>;

/// A rotation as a quaternion. q and -q are the same rotation.
struct Quaternion {
  double x = 0, y = 0, z = 0, w = 1;
};

/// Length; NaN or infinite if a number is not finite.
inline double length(const Quaternion& q) noexcept {
  return std::sqrt(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w);
}

/// The matrix of a quaternion of any length above 0.
inline RotationMatrix matrix_of(const Quaternion& any) noexcept {
  const double scale = 1 / length(any);
  const Quaternion q{any.x * scale, any.y * scale, any.z * scale, any.w * scale};
  return {1 - 2 * (q.y * q.y + q.z * q.z), 2 * (q.x * q.y - q.z * q.w),
          2 * (q.x * q.z + q.y * q.w),     2 * (q.x * q.y + q.z * q.w),
          1 - 2 * (q.x * q.x + q.z * q.z), 2 * (q.y * q.z - q.x * q.w),
          2 * (q.x * q.z - q.y * q.w),     2 * (q.y * q.z + q.x * q.w),
          1 - 2 * (q.x * q.x + q.y * q.y)};
}

/// The quaternion, w >= 0, of a rotation matrix. The largest of its numbers is computed first, so
/// that the others are precise.
inline Quaternion quaternion_of(const RotationMatrix& r) noexcept {
  const double trace = r[0] + r[4] + r[8];
  Quaternion q;
  if (trace >= std::max({r[0], r[4], r[8]})) {
    q = {r[7] - r[5], r[2] - r[6], r[3] - r[1], 1 + trace};
  } else if (r[0] >= r[4] && r[0] >= r[8]) {
    q = {1 + r[0] - r[4] - r[8], r[1] + r[3], r[2] + r[6], r[7] - r[5]};
  } else if (r[4] >= r[8]) {
    q = {r[1] + r[3], 1 - r[0] + r[4] - r[8], r[5] + r[7], r[2] - r[6]};
  } else {
    q = {r[2] + r[6], r[5] + r[7], 1 - r[0] - r[4] + r[8], r[3] - r[1]};
  }
  const double scale = (q.w < 0 ? -1 : 1) / length(q);
  return {q.x * scale, q.y * scale, q.z * scale, q.w * scale};
}

/// The rotation a fraction of the way from `from` to `to`, both of unit length, at constant angular
/// velocity along the shorter way.
inline Quaternion between(const Quaternion& from, Quaternion to, double fraction) noexcept {
  double cosine = from.x * to.x + from.y * to.y + from.z * to.z + from.w * to.w;
  if (cosine < 0) {
    to = {-to.x, -to.y, -to.z, -to.w};
    cosine = -cosine;
  }
  double a = 1 - fraction;
  double b = fraction;
  constexpr double nearly_equal = 0.9999999;  // below, the sine divides without loss of precision
  if (cosine < nearly_equal) {
    const double angle = std::acos(cosine);
    a = std::sin(a * angle) / std::sin(angle);
    b = std::sin(b * angle) / std::sin(angle);
  }
  const Quaternion sum{a * from.x + b * to.x, a * from.y + b * to.y, a * from.z + b * to.z,
                       a * from.w + b * to.w};
  const double scale = 1 / length(sum);
  return {sum.x * scale, sum.y * scale, sum.z * scale, sum.w * scale};
}

/// The product of two matrices.
inline RotationMatrix product(const RotationMatrix& a, const RotationMatrix& b) noexcept {
  RotationMatrix out{};
  for (std::size_t row = 0; row < 9; row += 3) {
    for (std::size_t column = 0; column < 3; ++column) {
      out[row + column] =
          a[row] * b[column] + a[row + 1] * b[column + 3] + a[row + 2] * b[column + 6];
    }
  }
  return out;
}

/// The inverse of a rotation.
inline RotationMatrix transposed(const RotationMatrix& r) noexcept {
  return {r[0], r[3], r[6], r[1], r[4], r[7], r[2], r[5], r[8]};
}

/// The nearest rotation to a matrix that is a rotation within about 1e-3.
inline RotationMatrix nearest_rotation(RotationMatrix r) noexcept {
  constexpr int rounds = 3;  // each squares the error: 1e-3, 1e-6, 1e-12, 1e-24
  for (int round = 0; round < rounds; ++round) {
    RotationMatrix step = product(transposed(r), r);
    for (std::size_t i = 0; i < 9; ++i) step[i] = (i % 4 == 0 ? 1.5 : 0) - 0.5 * step[i];
    r = product(r, step);
  }
  return r;
}

/// Axis times angle in radians, 0 to pi, of a rotation.
inline std::array<double, 3> rotation_vector(const RotationMatrix& r) noexcept {
  const Quaternion q = quaternion_of(r);
  const double sine = std::sqrt(q.x * q.x + q.y * q.y + q.z * q.z);
  const double scale = sine > 1e-12 ? 2 * std::atan2(sine, q.w) / sine : 2;
  return {q.x * scale, q.y * scale, q.z * scale};
}

}  // namespace flagstone
