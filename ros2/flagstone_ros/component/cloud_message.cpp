// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "cloud_message.hpp"

#include <new>

namespace flagstone_ros {

using flagstone::Status;
using flagstone::ros::PointCloud2View;
using flagstone::ros::PointField;
using flagstone::ros::PointFieldType;

Status view_message(const sensor_msgs::msg::PointCloud2& message, PointCloud2View& view) try {
  view.clear();
  if (message.fields.size() > flagstone::ros::max_point_fields) {
    return Status(flagstone::StatusCode::invalid_argument,
                  std::to_string(message.fields.size()) +
                      " fields are too many (expected at most " +
                      std::to_string(flagstone::ros::max_point_fields) + ")");
  }
  view.header.sec = message.header.stamp.sec;
  view.header.nanosec = message.header.stamp.nanosec;
  view.header.frame_id = message.header.frame_id;
  view.height = message.height;
  view.width = message.width;
  for (const auto& field : message.fields) {
    view.fields.push_back(PointField{.name = field.name,
                                     .offset = field.offset,
                                     .type = static_cast<PointFieldType>(field.datatype),
                                     .count = field.count});
  }
  view.is_bigendian = message.is_bigendian;
  view.point_step = message.point_step;
  view.row_step = message.row_step;
  view.data = std::as_bytes(std::span(message.data));
  view.is_dense = message.is_dense;
  Status status = check(view);
  if (!status.ok()) view.clear();
  return status;
} catch (const std::bad_alloc&) {
  return Status(flagstone::StatusCode::out_of_memory);
}

void write_message(const flagstone::ros::DerivedCloud& derived,
                   sensor_msgs::msg::PointCloud2& message) {
  const PointCloud2View& layout = derived.layout();
  message.header.stamp.sec = static_cast<std::int32_t>(layout.header.sec);
  message.header.stamp.nanosec = layout.header.nanosec;
  message.header.frame_id = layout.header.frame_id;
  message.height = layout.height;
  message.width = layout.width;
  message.fields.resize(layout.fields.size());
  for (std::size_t i = 0; i < layout.fields.size(); ++i) {
    const PointField& field = layout.fields[i];
    message.fields[i].name = field.name;
    message.fields[i].offset = field.offset;
    message.fields[i].datatype = static_cast<std::uint8_t>(field.type);
    message.fields[i].count = field.count;
  }
  message.is_bigendian = layout.is_bigendian;
  message.point_step = layout.point_step;
  message.row_step = layout.row_step;
  message.data.resize(derived.data_size());
  derived.write_data(std::as_writable_bytes(std::span(message.data)));
  message.is_dense = layout.is_dense;
}

}  // namespace flagstone_ros
