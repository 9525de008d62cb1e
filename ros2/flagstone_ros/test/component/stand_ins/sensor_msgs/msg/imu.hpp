// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include "std_msgs/msg/header.hpp"

namespace sensor_msgs::msg {
struct Imu {
  std_msgs::msg::Header header;
  geometry_msgs::msg::Vector3 linear_acceleration;
};
}  // namespace sensor_msgs::msg
