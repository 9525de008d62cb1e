// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "library/mount/gravity_alignment.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "library/core/floating_point_mode.hpp"

namespace flagstone::mount {
namespace {

/// Coordinates are cut off here, metres: far beyond what any method looks at, so that products of
/// finite numbers stay finite.
constexpr float farthest = 1e12f;

/// Where a point goes that would land in the very place of the sensor, which means "no echo".
constexpr float next_to_sensor = 1e-6f;

/// All of the arithmetic is the same for every point, without branches, for the compiler to make
/// vectors of.
struct ToLevel {
  Turn turn;
  Vector3f origin;  // and what is subtracted after the turn
  float scale;
  float lift;

  void operator()(const Point& p, float* to) const noexcept {
    const bool is_zero = (p.x == 0) & (p.y == 0) & (p.z == 0);
    // 0 for finite numbers, NaN for others, which a comparison in min or max could lose.
    const float trouble = (p.x - p.x) + (p.y - p.y) + (p.z - p.z);
    const float x = std::clamp(p.x * scale, -farthest, farthest) - origin[0];
    const float y = std::clamp(p.y * scale, -farthest, farthest) - origin[1];
    const float z = std::clamp(p.z * scale, -farthest, farthest) - origin[2];
    const float level_x = turn.x[0] * x + turn.x[1] * y + turn.x[2] * z;
    const float level_y = turn.y[0] * x + turn.y[1] * y + turn.y[2] * z;
    const float level_z = turn.z[0] * x + turn.z[1] * y + turn.z[2] * z + lift;
    const bool would_be_zero = (level_x == 0) & (level_y == 0) & (level_z == 0);
    to[0] = is_zero ? 0 : (would_be_zero ? next_to_sensor : level_x) + trouble;
    to[1] = is_zero ? 0 : level_y;
    to[2] = is_zero ? 0 : level_z;
  }
};

/// `floats` a point, known when this is compiled.
template <std::size_t floats>
void level_packed(const float* from, std::size_t count, const ToLevel& to_level,
                  float* to) noexcept {
  for (std::size_t i = 0; i < count; ++i) {
    to_level({from[floats * i], from[floats * i + 1], from[floats * i + 2]}, to + 3 * i);
  }
}

/// Floats a point if x, y and z stand first in records of aligned floats, else 0.
std::ptrdiff_t floats_a_point(CloudView cloud) noexcept {
  constexpr std::ptrdiff_t size = sizeof(float);
  const CloudLayout& layout = cloud.layout();
  const bool is_packed = layout.x == 0 && layout.y == size && layout.z == 2 * size &&
                         layout.stride % size == 0 &&
                         reinterpret_cast<std::uintptr_t>(cloud.data()) % alignof(float) == 0;
  return is_packed ? layout.stride / size : 0;
}

}  // namespace

void GravityAlignment::set(const Mount& mount) noexcept {
  mount_ = mount;
  turn_ = turn_to_z(mount.up);
  lift_ = mount.sensor_height - method_height_;
  const Vector3f none = {0, 0, 0};
  const Vector3f z = {0, 0, 1};
  is_identity_ = mount.up == z && mount.origin == none && mount.scale == 1 && lift_ == 0;
}

CloudView GravityAlignment::apply(CloudView cloud) {
  const ScopedFloatingPointMode same_everywhere;
  levelled_.reserve(3 * cloud.size());
  float* const to = levelled_.data();
  const ToLevel to_level = {turn_, mount_.origin, mount_.scale, lift_};
  const auto* const from = static_cast<const float*>(cloud.data());
  switch (floats_a_point(cloud)) {
    case 3: level_packed<3>(from, cloud.size(), to_level, to); break;
    case 4: level_packed<4>(from, cloud.size(), to_level, to); break;
    case 5: level_packed<5>(from, cloud.size(), to_level, to); break;
    default:
      for (std::size_t i = 0; i < cloud.size(); ++i) to_level(cloud[i], to + 3 * i);
  }
  return {to, cloud.size()};
}

void GravityAlignment::bring_back(Segmentation& result) const noexcept {
  for (Patch& patch : result.mutable_patches()) {
    const bool has_plane = patch.normal != Vector3f{0, 0, 0};
    if (!has_plane) continue;
    const Vector3f lowered = {patch.mean[0], patch.mean[1], patch.mean[2] - lift_};
    const Vector3f from_sensor = turn_.undo(lowered);
    for (std::size_t i = 0; i < 3; ++i) {
      patch.mean[i] = (from_sensor[i] + mount_.origin[i]) / mount_.scale;
    }
    // n . p + d = 0 with p = turn(scale * q - origin) + lift: divided by the scale.
    const float d = patch.d + patch.normal[2] * lift_;
    patch.normal = turn_.undo(patch.normal);
    patch.d = (d - dot(patch.normal, mount_.origin)) / mount_.scale;
  }
  if (lift_ == 0 || result.surface().empty()) return;
  for (GroundSurface::Grid& grid : result.mutable_surface().start()) {
    for (float& height : grid.heights) height -= lift_;
  }
}

}  // namespace flagstone::mount
