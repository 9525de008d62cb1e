// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "transform.hpp"

#include <cmath>
#include <cstddef>
#include <cstring>

namespace flagstone_ros {
namespace {

Vector product(const std::array<double, 9>& m, const Vector& v) {
  return {m[0] * v[0] + m[1] * v[1] + m[2] * v[2], m[3] * v[0] + m[4] * v[1] + m[5] * v[2],
          m[6] * v[0] + m[7] * v[1] + m[8] * v[2]};
}

}  // namespace

std::optional<Transform> transform_of(const Vector& translation, const Quaternion& rotation) {
  const auto [x, y, z, w] = rotation;
  const double square = x * x + y * y + z * z + w * w;
  const double sum = translation[0] + translation[1] + translation[2];
  if (!(square > 1e-12) || !std::isfinite(square) || !std::isfinite(sum)) return std::nullopt;
  Transform transform{.translation = translation};
  const double s = 2 / square;
  transform.rotation = {1 - s * (y * y + z * z), s * (x * y - z * w),     s * (x * z + y * w),
                        s * (x * y + z * w),     1 - s * (x * x + z * z), s * (y * z - x * w),
                        s * (x * z - y * w),     s * (y * z + x * w),     1 - s * (x * x + y * y)};
  return transform;
}

Transform operator*(const Transform& outer, const Transform& inner) {
  Transform both;
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t column = 0; column < 3; ++column) {
      double sum = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        sum += outer.rotation[3 * row + k] * inner.rotation[3 * k + column];
      }
      both.rotation[3 * row + column] = sum;
    }
  }
  both.translation = product(outer.rotation, inner.translation);
  for (std::size_t i = 0; i < 3; ++i) both.translation[i] += outer.translation[i];
  return both;
}

Transform inverse(const Transform& transform) {
  const auto& m = transform.rotation;
  Transform back{.rotation = {m[0], m[3], m[6], m[1], m[4], m[7], m[2], m[5], m[8]}};
  back.translation = product(back.rotation, transform.translation);
  for (double& coordinate : back.translation) coordinate = 0 - coordinate;
  return back;
}

Vector rotate(const Transform& transform, const Vector& direction) {
  return product(transform.rotation, direction);
}

Transform levelling(const Vector& up) {
  const double length = std::hypot(up[0], up[1], up[2]);
  const double x = up[0] / length;
  const double y = up[1] / length;
  const double z = up[2] / length;
  if (z < -1 + 1e-9) return {.rotation = {1, 0, 0, 0, -1, 0, 0, 0, -1}};  // upside down: about x
  const double k = 1 / (1 + z);
  return {.rotation = {1 - k * x * x, -k * x * y, -x, -k * x * y, 1 - k * y * y, -y, x, y, z}};
}

void transform_points(const Transform& transform, double scale, flagstone::CloudView from,
                      std::vector<float>& to) {
  to.resize(3 * from.size());
  const auto& m = transform.rotation;
  const Vector t = {transform.translation[0] / scale, transform.translation[1] / scale,
                    transform.translation[2] / scale};
  const auto* point = static_cast<const std::byte*>(from.data());
  const flagstone::CloudLayout& layout = from.layout();
  float* out = to.data();
  for (std::size_t i = 0; i < from.size(); ++i, point += layout.stride, out += 3) {
    std::memcpy(&out[0], point + layout.x, sizeof(float));
    std::memcpy(&out[1], point + layout.y, sizeof(float));
    std::memcpy(&out[2], point + layout.z, sizeof(float));
    const double x = out[0];
    const double y = out[1];
    const double z = out[2];
    const bool is_missing = x == 0 && y == 0 && z == 0;
    if (is_missing || !std::isfinite(x + y + z)) continue;
    out[0] = static_cast<float>(m[0] * x + m[1] * y + m[2] * z + t[0]);
    out[1] = static_cast<float>(m[3] * x + m[4] * y + m[5] * z + t[1]);
    out[2] = static_cast<float>(m[6] * x + m[7] * y + m[8] * z + t[2]);
  }
}

}  // namespace flagstone_ros
