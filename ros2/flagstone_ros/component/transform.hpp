// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "flagstone/cloud_view.hpp"

namespace flagstone_ros {

using Vector = std::array<double, 3>;

/// A rigid transform: p is at `rotation * p + translation` in the new frame.
struct Transform {
  std::array<double, 9> rotation = {1, 0, 0, 0, 1, 0, 0, 0, 1};  ///< row by row
  Vector translation = {0, 0, 0};                                ///< metres

  friend bool operator==(const Transform&, const Transform&) = default;
};

/// x, y, z and w of a rotation, of any length above 0.
using Quaternion = std::array<double, 4>;

/// The transform of a geometry_msgs/Transform. Nothing if a value is not finite or the quaternion
/// is zero.
[[nodiscard]] std::optional<Transform> transform_of(const Vector& translation,
                                                    const Quaternion& rotation);

/// First `inner`, then `outer`.
[[nodiscard]] Transform operator*(const Transform& outer, const Transform& inner);

[[nodiscard]] Transform inverse(const Transform& transform);

/// The rotation of a direction.
[[nodiscard]] Vector rotate(const Transform& transform, const Vector& direction);

/// The shortest rotation that brings `up`, of any length above 0, to the z axis.
[[nodiscard]] Transform levelling(const Vector& up);

/// The transformed points of `from` as packed x, y and z in `to`. Coordinates are multiplied by
/// `scale`, metres per unit, only for the translation: the result has the unit of `from`. Points
/// that are all zero or not finite stay as they are, so that they are labelled invalid. Allocates
/// nothing if the capacity of `to` suffices.
void transform_points(const Transform& transform, double scale, flagstone::CloudView from,
                      std::vector<float>& to);

}  // namespace flagstone_ros
