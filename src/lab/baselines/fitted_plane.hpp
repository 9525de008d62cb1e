// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "flagstone/patch.hpp"
#include "lab/baselines/coordinates.hpp"
#include "library/core/moments.hpp"
#include "library/core/plane.hpp"

namespace flagstone::baselines {

/// The plane normal . p + d = 0 in single precision, so that loops over points use floats only.
struct SinglePrecisionPlane {
  float normal_x = 0;
  float normal_y = 0;
  float normal_z = 1;
  float d = 0;

  /// Signed distance of a point from the plane, positive on the normal's side, metres.
  [[nodiscard]] float distance(float x, float y, float z) const noexcept {
    return normal_x * x + normal_y * y + normal_z * z + d;
  }
};

/// Converts a plane to single precision.
SinglePrecisionPlane single_precision(const Plane& plane) noexcept;

/// Fits a plane to the points for which `in_set(x, y, z)` is true.
template <class InSet>
Plane fit_plane(const Coordinates& points, const InSet& in_set) noexcept {
  if (points.size() == 0) return {};
  const Vector3 origin = {points.x[0], points.y[0], points.z[0]};
  Moments moments;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!in_set(points.x[i], points.y[i], points.z[i])) continue;
    moments.add(points.x[i] - origin[0], points.y[i] - origin[1], points.z[i] - origin[2]);
  }
  return plane_of(moments).moved_by(origin);
}

/// Writes the plane to `patch` and sets its `verdict` to `ground`.
void set_ground_plane(const Plane& fit, Patch& patch) noexcept;

}  // namespace flagstone::baselines
