// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>

namespace flagstone {

/// A point or vector in double precision: metres, sensor frame.
using Vector3 = std::array<double, 3>;

/// Entries xx, xy, xz, yy, yz, zz of a symmetric 3 x 3 matrix.
using Symmetric3 = std::array<double, 6>;

/// Sums over a set of points, from which its mean and covariance are computed. Use an origin near
/// the points: the subtraction of the mean from the squares then loses no precision.
struct Moments {
  double count = 0;
  Vector3 sum{};         ///< sums of x, y, z
  Symmetric3 squares{};  ///< sums of xx, xy, xz, yy, yz, zz

  void add(double x, double y, double z) noexcept {
    count += 1;
    sum[0] += x;
    sum[1] += y;
    sum[2] += z;
    squares[0] += x * x;
    squares[1] += x * y;
    squares[2] += x * z;
    squares[3] += y * y;
    squares[4] += y * z;
    squares[5] += z * z;
  }

  /// Mean, relative to the same origin. Requires count > 0.
  [[nodiscard]] Vector3 mean() const noexcept {
    return {sum[0] / count, sum[1] / count, sum[2] / count};
  }

  /// Covariance C of eq. (4), with divisor count - 1. Requires count > 1.
  [[nodiscard]] Symmetric3 covariance() const noexcept {
    const Vector3 m = mean();
    const double n = count - 1;
    return {(squares[0] - sum[0] * m[0]) / n, (squares[1] - sum[0] * m[1]) / n,
            (squares[2] - sum[0] * m[2]) / n, (squares[3] - sum[1] * m[1]) / n,
            (squares[4] - sum[1] * m[2]) / n, (squares[5] - sum[2] * m[2]) / n};
  }
};

}  // namespace flagstone
