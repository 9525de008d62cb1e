// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace flagstone::mount {

/// A direction, or a position in metres.
using Vector3f = std::array<float, 3>;

constexpr float dot(const Vector3f& a, const Vector3f& b) noexcept {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// Scales a vector to unit length. Its length must be 1e-30 to 1e30.
inline Vector3f unit(const Vector3f& v) noexcept {
  const double x = v[0];
  const double y = v[1];
  const double z = v[2];
  const double length = std::sqrt(x * x + y * y + z * z);
  return {static_cast<float>(x / length), static_cast<float>(y / length),
          static_cast<float>(z / length)};
}

/// The angle between two unit vectors, degrees.
inline float degrees_between(const Vector3f& a, const Vector3f& b) noexcept {
  // Computed from the chord, because the cosine is inaccurate for small angles.
  const Vector3f chord = {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
  const float half = std::min(std::sqrt(dot(chord, chord)) / 2, 1.0f);
  return 2 * std::asin(half) * static_cast<float>(180 / std::numbers::pi);
}

/// The shortest rotation that brings a direction to z, as rows of a matrix.
struct Turn {
  Vector3f x{1, 0, 0};
  Vector3f y{0, 1, 0};
  Vector3f z{0, 0, 1};

  [[nodiscard]] Vector3f apply(const Vector3f& v) const noexcept {
    return {dot(x, v), dot(y, v), dot(z, v)};
  }
  /// The inverse rotation.
  [[nodiscard]] Vector3f undo(const Vector3f& v) const noexcept {
    return {x[0] * v[0] + y[0] * v[1] + z[0] * v[2], x[1] * v[0] + y[1] * v[1] + z[1] * v[2],
            x[2] * v[0] + y[2] * v[1] + z[2] * v[2]};
  }
};

/// The rotation that brings the unit vector `up` to z. If `up` is -z, it rotates about x.
inline Turn turn_to_z(const Vector3f& up) noexcept {
  const auto [ux, uy, uz] = up;
  if (uz < -0.999999f) return {.x = {1, 0, 0}, .y = {0, -1, 0}, .z = {0, 0, -1}};
  const float k = 1 / (1 + uz);
  return {.x = {1 - ux * ux * k, -ux * uy * k, -ux},
          .y = {-ux * uy * k, 1 - uy * uy * k, -uy},
          .z = up};
}

}  // namespace flagstone::mount
