// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

namespace flagstone::sim {

/// A point or a direction, metres. Double precision, because ground truth is computed more
/// precisely than scans are stored.
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

/// An interval of values.
struct Interval {
  double low = 0, high = 0;
};

/// The pose of a sensor or an object in the world frame. The axes are orthonormal: x forward, y
/// left, z up.
struct Frame {
  Vector3 origin;
  Vector3 forward{1, 0, 0};
  Vector3 left{0, 1, 0};
  Vector3 up{0, 0, 1};

  /// Converts a direction from this frame to world coordinates.
  [[nodiscard]] Vector3 direction_to_world(Vector3 local) const noexcept {
    return local.x * forward + local.y * left + local.z * up;
  }
  /// Converts a point from this frame to world coordinates.
  [[nodiscard]] Vector3 to_world(Vector3 local) const noexcept {
    return origin + direction_to_world(local);
  }
  /// Converts a point from world coordinates to this frame.
  [[nodiscard]] Vector3 to_local(Vector3 world) const noexcept {
    const Vector3 from_origin = world - origin;
    return {dot(from_origin, forward), dot(from_origin, left), dot(from_origin, up)};
  }
};

/// An upright frame at `origin`, turned by `yaw` (radians, counter-clockwise from the x axis).
inline Frame upright_frame(Vector3 origin, double yaw) {
  return {.origin = origin,
          .forward = {std::cos(yaw), std::sin(yaw), 0},
          .left = {-std::sin(yaw), std::cos(yaw), 0},
          .up = {0, 0, 1}};
}

/// `frame` moved by `distance` metres along its z axis.
constexpr Frame raised(Frame frame, double distance) noexcept {
  frame.origin = frame.origin + distance * frame.up;
  return frame;
}

}  // namespace flagstone::sim
