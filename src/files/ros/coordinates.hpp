// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <vector>

#include "files/ros/point_cloud2.hpp"
#include "flagstone/cloud_view.hpp"
#include "flagstone/status.hpp"

namespace flagstone::ros {

/// Whether view_coordinates() is zero-copy: x, y and z are float32 in the byte order of this
/// machine, and the distance between all consecutive points is the same.
[[nodiscard]] bool has_native_coordinates(const PointCloud2View& cloud) noexcept;

/// x, y and z of every point, row by row: a view of `cloud.data` if has_native_coordinates(),
/// otherwise of `copy`, into which they are converted. `out` is valid as long as that memory.
/// Allocates nothing if the capacity of `copy` suffices, so pass the same vector for many messages.
///
/// float64 and integers are rounded to float32; their unit is not changed. `cloud` must satisfy
/// check(). bad_file if x, y or z is missing, is not a single number, or is a boolean or of an
/// unknown type; out_of_memory. Never throws; changes `out` only on success.
Status view_coordinates(const PointCloud2View& cloud, std::vector<float>& copy, CloudView& out);

/// Coordinates in another frame: `rotation` times the coordinates, plus `translation`.
struct RigidTransform {
  std::array<double, 9> rotation{1, 0, 0, 0, 1, 0, 0, 0, 1};  ///< row by row
  std::array<double, 3> translation{0, 0, 0};                 ///< in the unit of the cloud
};

/// x, y and z of every point in another frame, packed, row by row. Missing returns, which are all
/// zero, stay all zero; no other point becomes all zero. Errors as view_coordinates().
Status transform_coordinates(const PointCloud2View& cloud, const RigidTransform& transform,
                             std::vector<float>& out);

}  // namespace flagstone::ros
