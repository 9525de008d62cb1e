// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>

#include "files/ros/derived_cloud.hpp"
#include "files/ros/point_cloud2.hpp"
#include "sensor_msgs/msg/point_cloud2.hpp"

/// Between messages that a ROS client library has deserialized and the codec.
namespace flagstone_ros {

/// A view of a message, without copying. The message must outlive it. invalid_argument if the
/// message contradicts itself; out_of_memory.
flagstone::Status view_message(const sensor_msgs::msg::PointCloud2& message,
                               flagstone::ros::PointCloud2View& view);

/// Writes a derived cloud with its header to a message. Throws std::bad_alloc.
void write_message(const flagstone::ros::DerivedCloud& derived,
                   sensor_msgs::msg::PointCloud2& message);

}  // namespace flagstone_ros
