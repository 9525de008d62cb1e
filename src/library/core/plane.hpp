// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "flagstone/patch.hpp"
#include "library/core/moments.hpp"

namespace flagstone {

/// What principal component analysis of a covariance gives, eq. (4).
struct PrincipalAxes {
  Vector3 eigenvalues;  ///< lambda_1 >= lambda_2 >= lambda_3 >= 0, m^2
  Vector3 normal;       ///< v_3, unit length, z >= 0
};

/// Eigenvalues and the normal of a covariance, by + - * / and square root alone, so that the bits
/// do not depend on a mathematics library.
///
/// Where the points do not fix a plane, the most upright one is taken: through points on a line
/// (lambda_2 - lambda_3 at most 1e-6 of the trace) the plane that contains the line and leans
/// least, through a single place the horizontal one.
///
/// The normal of an upright plane (z within 1e-6 of 0) is level; the larger of its x and y is
/// positive, so that rounding does not decide which side is above.
PrincipalAxes principal_axes(const Symmetric3& covariance) noexcept;

/// A plane n . p + d = 0 and the set of points it was fitted to, eq. (4).
struct Plane {
  double count = 0;       ///< points in the set; a plane needs three
  Vector3 mean{};         ///< p-bar, metres
  Vector3 normal{};       ///< n = v_3, unit length, z >= 0
  double d = 0;           ///< -n . p-bar, metres
  Vector3 eigenvalues{};  ///< lambda_1 >= lambda_2 >= lambda_3, m^2

  [[nodiscard]] bool exists() const noexcept { return count >= 3; }

  /// A plane in coordinates taken from `origin`, in those that `origin` is given in.
  [[nodiscard]] Plane moved_by(const Vector3& origin) const noexcept;
};

/// The plane of least squares through the points of these moments; none if they are fewer than
/// three.
Plane plane_of(const Moments& moments) noexcept;

/// Writes mean, normal, d and eigenvalues of a plane into a patch.
void set_plane(const Plane& plane, Patch& patch) noexcept;

/// Planes that are fitted together.
inline constexpr std::size_t batch_size = 16;

/// A number for each of them.
struct alignas(64) Batch : std::array<double, batch_size> {};

/// Moments, see there, of sixteen sets.
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

/// Fits sixteen planes. Bit i of what is returned says that plane i exists but hangs on the last
/// digits of its moments: points nearly on a line, in a ball, or together far from the origin.
/// Single precision is too coarse for sums of these.
std::uint32_t fit_planes(const MomentsBatch& moments, PlaneBatch& planes) noexcept;

}  // namespace flagstone
