// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "files/ros/point_cloud2.hpp"
#include "flagstone/status.hpp"

namespace flagstone::ros {

/// The members of a CustomMsg of Livox that are not in a PointCloud2.
struct LivoxMessage {
  std::uint64_t timebase = 0;  ///< time of the first point, nanoseconds
  std::uint8_t lidar_id = 0;
};

/// Reads a serialized CustomMsg of the drivers of Livox (livox_ros_driver, livox_interfaces and
/// livox_ros_driver2 have the same members) as a cloud, without copying its points. The cloud has
/// height 1 and the fields offset_time (uint32, nanoseconds after timebase), x, y, z (float32,
/// metres), reflectivity, tag and line (uint8). DerivedCloud makes PointCloud2 messages from it.
///
/// Errors and memory as parse().
Status parse_livox(std::span<const std::byte> message, Encoding encoding, PointCloud2View& out,
                   LivoxMessage& livox);

}  // namespace flagstone::ros
