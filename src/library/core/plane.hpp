// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "flagstone/patch.hpp"
#include "library/core/moments.hpp"

namespace flagstone {

/// Result of the principal component analysis of a covariance, eq. (4).
struct PrincipalAxes {
  Vector3 eigenvalues;  ///< lambda_1 >= lambda_2 >= lambda_3 >= 0, m^2
  Vector3 normal;       ///< v_3, unit length, z >= 0
};

/// Eigenvalues and the normal of a covariance. Uses only + - * / and square root, so that the bits
/// do not depend on a mathematical library.
///
/// If the points do not determine a plane, the plane with the most upright normal is used. For
/// points on a line (lambda_2 - lambda_3 at most 1e-6 of the trace), it is the plane with the
/// smallest tilt that contains the line. For points at a single position, it is horizontal.
///
/// A normal with z within 1e-6 of 0 is made horizontal, and the larger of its x and y is made
/// positive. Otherwise rounding would decide which side is up.
PrincipalAxes principal_axes(const Symmetric3& covariance) noexcept;

/// A plane n . p + d = 0 and the set of points it was fitted to, eq. (4).
struct Plane {
  double count = 0;       ///< number of points in the set; a plane needs three
  Vector3 mean{};         ///< p-bar, metres
  Vector3 normal{};       ///< n = v_3, unit length, z >= 0
  double d = 0;           ///< -n . p-bar, metres
  Vector3 eigenvalues{};  ///< lambda_1 >= lambda_2 >= lambda_3, m^2

  [[nodiscard]] bool exists() const noexcept { return count >= 3; }

  /// The same plane in the coordinates of `origin`, if this plane is relative to `origin`.
  [[nodiscard]] Plane moved_by(const Vector3& origin) const noexcept;
};

/// The least-squares plane through the points of these moments; none if there are fewer than three.
Plane plane_of(const Moments& moments) noexcept;

/// Writes mean, normal, d and eigenvalues of a plane into a patch.
void set_plane(const Plane& plane, Patch& patch) noexcept;

/// Number of planes fitted together.
inline constexpr std::size_t batch_size = 16;

/// One number per plane.
struct alignas(64) Batch : std::array<double, batch_size> {};

/// Moments of sixteen sets; see Moments.
struct MomentsBatch {
  Batch count;
  std::array<Batch, 3> sum;
  std::array<Batch, 6> squares;
};

/// Sixteen planes.
struct PlaneBatch {
  Batch count;
  std::array<Batch, 3> mean;
  std::array<Batch, 3> normal;
  Batch d;
  std::array<Batch, 3> eigenvalues;

  [[nodiscard]] Plane operator[](std::size_t i) const noexcept;
};

/// Fits sixteen planes. Bit i of the result is set if plane i exists but is ill-conditioned: its
/// points are nearly on a line, in a ball, or close together far from the origin. Sums in single
/// precision are then not accurate enough.
std::uint32_t fit_planes(const MomentsBatch& moments, PlaneBatch& planes) noexcept;

}  // namespace flagstone
