// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "library/ground_map/poses.hpp"

#include <cmath>
#include <cstddef>
#include <string>

namespace flagstone {

bool is_valid(const Pose& pose) noexcept {
  for (const double value : pose.position) {
    if (!(std::abs(value) <= max_world_position)) return false;
  }
  const auto& r = pose.rotation;
  constexpr double tolerance = 1e-3;
  for (std::size_t row = 0; row < 9; row += 3) {
    for (std::size_t other = row; other < 9; other += 3) {
      const double product =
          r[row] * r[other] + r[row + 1] * r[other + 1] + r[row + 2] * r[other + 2];
      if (!(std::abs(product - (row == other ? 1 : 0)) <= tolerance)) return false;
    }
  }
  const double determinant = r[0] * (r[4] * r[8] - r[5] * r[7]) -
                             r[1] * (r[3] * r[8] - r[5] * r[6]) +
                             r[2] * (r[3] * r[7] - r[4] * r[6]);
  return determinant > 0;
}

Status invalid_pose() {
  return Status(StatusCode::invalid_argument,
                "pose: is not a rotation and a position (expected finite numbers, orthonormal axes "
                "and positions up to 10,000 km)");
}

Status check_scan(const char* user, CloudView cloud, const Segmentation& result, const Pose& pose) {
  if (cloud.size() != result.labels().size() || cloud.size() != result.heights().size()) {
    return Status(StatusCode::invalid_argument,
                  std::string(user) +
                      ": the result has no heights of this cloud (expected the result of a method "
                      "such as surface for the same cloud)");
  }
  return is_valid(pose) ? Status() : invalid_pose();
}

}  // namespace flagstone
