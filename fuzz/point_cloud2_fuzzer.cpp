// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

#include "allocation_meter.hpp"
#include "cloud_properties.hpp"
#include "files/ros/coordinates.hpp"
#include "files/ros/derived_cloud.hpp"
#include "files/ros/field_convention.hpp"
#include "files/ros/livox_message.hpp"
#include "files/ros/point_cloud2.hpp"

namespace flagstone::fuzz {
namespace {

using ros::PointCloud2View;
using ros::PointField;

/// Makes the reads observable, so that a sanitizer detects a read out of bounds.
volatile double sink;

const std::byte* address_of(const PointCloud2View& cloud, std::size_t i) {
  return cloud.data.data() + i / cloud.width * cloud.row_stride() +
         i % cloud.width * cloud.point_stride();
}

/// Every coordinate can be read, or the status contains the reason.
void check_coordinates(const PointCloud2View& cloud) {
  std::vector<float> copy;
  CloudView points;
  const Status status = ros::view_coordinates(cloud, copy, points);
  if (!status.ok()) {
    require(status.code() == StatusCode::bad_file, "missing coordinates are a bad file");
    return require(!status.message().empty(), "an error has a message");
  }
  require(points.size() == cloud.size(), "the view has every point");
  double sum = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Point point = points[i];
    sum += static_cast<double>(point.x + point.y + point.z);
  }
  sink = sum;
}

/// A serialized cloud reads back unchanged, and serialization is deterministic.
void check_serialization(const PointCloud2View& cloud) {
  std::vector<std::byte> message;
  require(ros::serialize(cloud, message).ok(), "a parsed cloud can be serialized");
  PointCloud2View again;
  require(ros::parse(message, cloud.format.encoding, again).ok(), "a serialized cloud is valid");
  require(again.format == cloud.format && again.header == cloud.header, "the header is unchanged");
  require(again.fields == cloud.fields, "the fields are unchanged");
  require(std::ranges::equal(again.data, cloud.data), "the data is unchanged");
  std::vector<std::byte> twice;
  require(ros::serialize(again, twice).ok() && twice == message, "serialization is deterministic");
}

PointCloud2View parsed(const ros::DerivedCloud& derived, const PointCloud2View& source,
                       std::vector<std::byte>& message) {
  require(derived.write_message(message).ok(), "a derived cloud can be written");
  PointCloud2View result;
  require(ros::parse(message, source.format.encoding, result).ok(), "a derived cloud is valid");
  require(result.format == source.format && result.header == source.header,
          "the header of the source is kept");
  return result;
}

/// The bytes of all fields of the source, except for these names, are the same.
void check_point(const PointCloud2View& source, std::size_t i, const PointCloud2View& result,
                 std::size_t j) {
  for (const PointField& field : source.fields) {
    if (field.name == "label" || field.name == "height") continue;
    require(std::memcmp(address_of(source, i) + field.offset, address_of(result, j) + field.offset,
                        field.size()) == 0,
            "the fields of the source are kept");
  }
}

void check_append(const PointCloud2View& cloud, const std::vector<Label>& labels) {
  std::vector<float> heights(cloud.size(), 0.5F);
  const std::array added{ros::label_field(labels), ros::height_field(heights)};
  ros::DerivedCloud derived;
  const Status status = derived.append(cloud, added);
  if (!status.ok()) {
    return require(status.code() == StatusCode::invalid_argument, "a writer reports the reason");
  }
  std::vector<std::byte> message;
  const PointCloud2View result = parsed(derived, cloud, message);
  require(result.height == cloud.height && result.width == cloud.width, "the organization is kept");
  const PointField* const label = result.find("label");
  require(label != nullptr && result.find("height") != nullptr, "the fields are added");
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    check_point(cloud, i, result, i);
    require(address_of(result, i)[label->offset] == static_cast<std::byte>(labels[i]),
            "the labels are added");
  }
}

void check_select(const PointCloud2View& cloud, const std::vector<Label>& labels) {
  std::size_t total = 0;
  for (std::uint8_t code = 0; code < label_count; ++code) {
    const auto label = static_cast<Label>(code);
    ros::DerivedCloud derived;
    require(derived.select(cloud, ros::Selection(labels, {label})).ok(), "points can be selected");
    std::vector<std::byte> message;
    const PointCloud2View result = parsed(derived, cloud, message);
    std::size_t next = 0;
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      if (labels[i] == label) check_point(cloud, i, result, next++);
    }
    require(next == result.size(), "the selection has its points");
    total += next;
  }
  require(total == cloud.size(), "the selections partition the points");
}

void check_message(const PointCloud2View& cloud, bool is_padded) {
  require(ros::check(cloud).ok(), "a parsed cloud is valid");
  sink = ros::recognize(cloud.fields).seconds_per_unit;
  std::vector<Label> labels(cloud.size());
  for (std::size_t i = 0; i < labels.size(); ++i) labels[i] = static_cast<Label>(i * i % 7 % 5);
  check_coordinates(cloud);
  if (!is_padded) check_serialization(cloud);
  check_append(cloud, labels);
  check_select(cloud, labels);
}

}  // namespace
}  // namespace flagstone::fuzz

// The first byte selects the encoding and the type of the message, and the rest is the message.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace flagstone;
  if (size < 1) return 0;
  const auto encoding = (data[0] & 1U) != 0 ? ros::Encoding::ros1 : ros::Encoding::cdr;
  const bool is_livox = (data[0] & 2U) != 0;
  const auto message = std::as_bytes(std::span(data, size)).subspan(1);
  ros::PointCloud2View cloud;
  ros::LivoxMessage livox;
  const fuzz::AllocationMeter meter;
  const Status status = is_livox ? ros::parse_livox(message, encoding, cloud, livox)
                                 : ros::parse(message, encoding, cloud);
  meter.require_at_most(fuzz::plain_factor, size);
  fuzz::check_status(status);
  if (status.ok()) fuzz::check_message(cloud, cloud.padded_point_step != 0);
  return 0;
}
