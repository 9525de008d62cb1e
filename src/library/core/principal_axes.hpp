// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

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

}  // namespace flagstone
