// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "core/principal_axes.hpp"

#include <algorithm>
#include <cmath>

namespace flagstone {
namespace {

/// Gap between eigenvalues, as a share of their sum, under which they count as equal. Wide enough
/// that rounding (1e-16 of a determinant, divided by lambda_2) decides nothing.
constexpr double equal_share = 1e-6;

Vector3 cross(const Vector3& a, const Vector3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

double squared_length(const Vector3& v) { return v[0] * v[0] + v[1] * v[1] + v[2] * v[2]; }

const Vector3& longest(const Vector3& a, const Vector3& b, const Vector3& c) {
  const Vector3& ab = squared_length(b) > squared_length(a) ? b : a;
  return squared_length(c) > squared_length(ab) ? c : ab;
}

Vector3 unit_upward(const Vector3& v) {
  const double scale = (v[2] < 0 ? -1.0 : 1.0) / std::sqrt(squared_length(v));
  return {v[0] * scale, v[1] * scale, v[2] * scale};
}

/// Smallest root of lambda^3 - lambda^2 + c1 lambda - c0, which has three roots in [0, 1]. Left of
/// them the polynomial is negative, rising and concave: Newton's steps from 0 close in from the
/// left.
double smallest_root(double c1, double c0) {
  double root = 0;
  for (int step = 0; step < 60; ++step) {  // one or two dozen only where two roots are equal
    const double value = ((root - 1) * root + c1) * root - c0;
    const double slope = (3 * root - 2) * root + c1;
    if (!(value < 0) || !(slope > 0)) break;
    const double next = root - value / slope;
    if (!(next > root)) break;
    root = next;
  }
  return root;
}

Vector3 most_upright_normal_of_line(const Vector3& direction) {
  const Vector3 along = unit_upward(direction);
  const Vector3 upright = {-along[2] * along[0], -along[2] * along[1], 1 - along[2] * along[2]};
  if (squared_length(upright) < 1e-10) return {1, 0, 0};  // a vertical line
  return unit_upward(upright);
}

}  // namespace

PrincipalAxes principal_axes(const Symmetric3& c) noexcept {
  const double trace = c[0] + c[3] + c[5];
  if (!(trace > 0) || !std::isfinite(trace)) return {{0, 0, 0}, {0, 0, 1}};

  // Scaled to trace 1: the eigenvalues are shares.
  const double xx = c[0] / trace;
  const double xy = c[1] / trace;
  const double xz = c[2] / trace;
  const double yy = c[3] / trace;
  const double yz = c[4] / trace;
  const double zz = c[5] / trace;
  const double minors = xx * yy - xy * xy + xx * zz - xz * xz + yy * zz - yz * yz;
  const double determinant =
      xx * (yy * zz - yz * yz) - xy * (xy * zz - yz * xz) + xz * (xy * yz - yy * xz);

  const bool on_a_line = minors <= equal_share;  // about lambda_2 + lambda_3; the rest is rounding
  const double l3 = on_a_line ? 0 : smallest_root(minors, determinant);
  const double rest = 1 - l3;                 // lambda_1 + lambda_2
  const double product = minors - l3 * rest;  // lambda_1 * lambda_2
  const double gap = std::sqrt(std::max(rest * rest - 4 * product, 0.0));
  const double l1 = (rest + gap) / 2;
  const double l2 = std::max((rest - gap) / 2, l3);

  // Rows of C - lambda_3 I span what is orthogonal to the normal.
  const Vector3 r0 = {xx - l3, xy, xz};
  const Vector3 r1 = {xy, yy - l3, yz};
  const Vector3 r2 = {xz, yz, zz - l3};
  PrincipalAxes axes{{l1 * trace, l2 * trace, l3 * trace}, {0, 0, 1}};
  if (l2 - l3 > equal_share) {
    axes.normal = unit_upward(longest(cross(r0, r1), cross(r0, r2), cross(r1, r2)));
  } else if (l1 - l3 > equal_share) {
    axes.normal = most_upright_normal_of_line(longest(r0, r1, r2));
  }
  return axes;
}

}  // namespace flagstone
