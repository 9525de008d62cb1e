// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include "rclcpp/rclcpp.hpp"

#define RCLCPP_COMPONENTS_REGISTER_NODE(NodeClass)                                              \
  std::shared_ptr<rclcpp::Node> make_registered_component(const rclcpp::NodeOptions& options) { \
    return std::make_shared<NodeClass>(options);                                                \
  }
