// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "sensor_msgs/msg/point_cloud2.hpp"

namespace flagstone_ros {

/// A sensor 1.73 m above flat ground, 20 m in all directions, with a wall of 1 m ahead: x, y, z,
/// intensity float32, ring uint16, and two bytes of padding that are not 0.
class Scene {
 public:
  static constexpr std::uint32_t point_step = 20;

  Scene() {
    for (int row = -80; row <= 80; ++row) {
      for (int column = -80; column <= 80; ++column) {
        if (row != 0 || column != 0)
          add(0.25f * static_cast<float>(row), 0.25f * static_cast<float>(column), -1.73f);
      }
    }
    ground_count = count();
    for (int i = 0; i < 400; ++i) {
      add(8, -2 + 0.05f * static_cast<float>(i % 80), -1.2f + 0.1f * static_cast<float>(i / 80));
    }
  }

  void add(float x, float y, float z) {
    const float intensity = static_cast<float>(count() % 97);
    const auto ring = static_cast<std::uint16_t>(count() % 64);
    std::uint8_t point[point_step] = {};
    std::memcpy(point, &x, 4);
    std::memcpy(point + 4, &y, 4);
    std::memcpy(point + 8, &z, 4);
    std::memcpy(point + 12, &intensity, 4);
    std::memcpy(point + 16, &ring, 2);
    point[18] = 0xab;
    point[19] = 0xcd;
    data_.insert(data_.end(), point, point + point_step);
  }

  /// Moves every point: `turn` about the x axis in radians, then `dx`, `dy`, `dz` metres.
  void move(double turn, double dx, double dy, double dz) {
    for (std::size_t i = 0; i < count(); ++i) {
      float p[3];
      std::memcpy(p, &data_[i * point_step], sizeof p);
      const double y = std::cos(turn) * p[1] - std::sin(turn) * p[2];
      const double z = std::sin(turn) * p[1] + std::cos(turn) * p[2];
      p[0] = static_cast<float>(p[0] + dx);
      p[1] = static_cast<float>(y + dy);
      p[2] = static_cast<float>(z + dz);
      std::memcpy(&data_[i * point_step], p, sizeof p);
    }
  }

  [[nodiscard]] std::size_t count() const { return data_.size() / point_step; }

  [[nodiscard]] sensor_msgs::msg::PointCloud2 message() const {
    sensor_msgs::msg::PointCloud2 message;
    message.header.stamp.sec = 1700000000;
    message.header.stamp.nanosec = 123456789;
    message.header.frame_id = "lidar";
    message.height = 1;
    message.width = static_cast<std::uint32_t>(count());
    const auto add_field = [&](const char* name, std::uint32_t offset, std::uint8_t datatype) {
      auto& field = message.fields.emplace_back();
      field.name = name;
      field.offset = offset;
      field.datatype = datatype;
      field.count = 1;
    };
    add_field("x", 0, 7);
    add_field("y", 4, 7);
    add_field("z", 8, 7);
    add_field("intensity", 12, 7);
    add_field("ring", 16, 4);
    message.point_step = point_step;
    message.row_step = message.width * point_step;
    message.data = data_;
    message.is_dense = true;
    return message;
  }

  std::size_t ground_count = 0;

 private:
  std::vector<std::uint8_t> data_;
};

}  // namespace flagstone_ros
