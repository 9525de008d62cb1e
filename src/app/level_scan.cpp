// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "app/level_scan.hpp"

#include <array>
#include <cstddef>

#include "library/mount/vectors.hpp"

namespace flagstone::app {
namespace {

bool is_level(const Mount& mount) noexcept {
  return mount.up[0] == 0 && mount.up[1] == 0 && mount.up[2] > 0 &&
         mount.origin == std::array<float, 3>{} && mount.scale == 1;
}

}  // namespace

void LevelScan::set(CloudView cloud, const Mount& mount, const Pose& pose) {
  cloud_ = cloud;
  pose_ = pose;
  if (is_level(mount)) return;

  const mount::Turn turn = mount::turn_to_z(mount::unit(mount.up));
  xyz_.resize(3 * cloud.size());
  float* to = xyz_.data();
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Point point = cloud[i];
    const mount::Vector3f levelled = turn.apply({mount.scale * point.x - mount.origin[0],
                                                 mount.scale * point.y - mount.origin[1],
                                                 mount.scale * point.z - mount.origin[2]});
    for (const float coordinate : levelled) *to++ = coordinate;
  }
  cloud_ = CloudView(xyz_.data(), cloud.size());

  // A level point l is at rotation * (turn^T l + origin) + position.
  const std::array axes = {turn.x, turn.y, turn.z};
  for (std::size_t row = 0; row < 3; ++row) {
    const double* const from = pose.rotation.data() + 3 * row;
    for (std::size_t column = 0; column < 3; ++column) {
      const mount::Vector3f& axis = axes[column];
      pose_.rotation[3 * row + column] =
          from[0] * double{axis[0]} + from[1] * double{axis[1]} + from[2] * double{axis[2]};
    }
    pose_.position[row] += from[0] * double{mount.origin[0]} + from[1] * double{mount.origin[1]} +
                           from[2] * double{mount.origin[2]};
  }
}

}  // namespace flagstone::app
