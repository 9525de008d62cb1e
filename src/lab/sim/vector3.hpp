// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

namespace flagstone::sim {

/// A point or a direction, metres, in double precision: the truth is computed finer than a scan
/// stores it.
struct Vector3 {
  double x = 0, y = 0, z = 0;

  constexpr Vector3() noexcept = default;
  constexpr Vector3(double x_value, double y_value, double z_value) noexcept
      : x(x_value), y(y_value), z(z_value) {}

  friend constexpr bool operator==(Vector3, Vector3) noexcept = default;
  friend constexpr Vector3 operator+(Vector3 a, Vector3 b) noexcept {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
  }
  friend constexpr Vector3 operator-(Vector3 a, Vector3 b) noexcept {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
  }
  friend constexpr Vector3 operator*(double s, Vector3 a) noexcept {
    return {s * a.x, s * a.y, s * a.z};
  }
};

constexpr double dot(Vector3 a, Vector3 b) noexcept { return a.x * b.x + a.y * b.y + a.z * b.z; }

constexpr Vector3 cross(Vector3 a, Vector3 b) noexcept {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

inline double length(Vector3 a) noexcept { return std::sqrt(dot(a, a)); }

/// `a` scaled to length 1; `a` must not be zero.
inline Vector3 normalized(Vector3 a) noexcept { return (1 / length(a)) * a; }

}  // namespace flagstone::sim
