// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
// Properties of the codec for random messages: any fields, steps, padding, byte orders and points.

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cstring>
#include <string>
#include <vector>

#include "files/ros/coordinates.hpp"
#include "files/ros/derived_cloud.hpp"
#include "files/ros/messages.hpp"

namespace flagstone::ros {
namespace {

const std::vector<std::string> field_names{"x",     "y",      "z",    "intensity", "ring",
                                           "label", "height", "time", "_",         ""};

Bytes random_bytes(std::size_t size) {
  const auto values =
      *rc::gen::container<std::vector<std::uint8_t>>(size, rc::gen::arbitrary<std::uint8_t>());
  const auto bytes = std::as_bytes(std::span(values));
  return {bytes.begin(), bytes.end()};
}

std::uint32_t random_number(std::uint32_t end) { return *rc::gen::inRange<std::uint32_t>(0, end); }

/// A message with up to 12 fields, which may overlap, and up to 8 rows of up to 8 points.
CloudMessage random_message() {
  CloudMessage message;
  message.format = *rc::gen::elementOf(all_formats);
  message.frame_id = *rc::gen::elementOf(std::vector<std::string>{"", "a", "lidar/top", "four"});
  message.height = random_number(9);
  message.width = random_number(9);
  message.point_step = 1 + random_number(80);
  message.row_step = message.width * message.point_step + random_number(2) * random_number(30);
  message.is_bigendian = *rc::gen::arbitrary<bool>();
  message.is_dense = *rc::gen::arbitrary<bool>();
  message.data = random_bytes(std::size_t{message.height} * message.row_step);
  const std::uint32_t fields = random_number(13);
  for (std::uint32_t i = 0; i < fields; ++i) {
    PointField field{field_names[random_number(static_cast<std::uint32_t>(field_names.size()))], 0,
                     static_cast<PointFieldType>(1 + random_number(12)), random_number(4)};
    if (field.size() > message.point_step) continue;
    field.offset = random_number(message.point_step - static_cast<std::uint32_t>(field.size()) + 1);
    message.fields.push_back(field);
  }
  return message;
}

std::vector<Label> random_labels(std::size_t size) {
  std::vector<Label> labels(size);
  for (Label& label : labels) label = static_cast<Label>(random_number(5));
  return labels;
}

const std::byte* address_of(const PointCloud2View& cloud, std::size_t i) {
  return cloud.data.data() + i / cloud.width * cloud.row_stride() +
         i % cloud.width * cloud.point_stride();
}

/// Whether all bytes of point i of `a` are equal in point j of `b`, except for
/// the fields of `b` with these names.
bool has_same_point(const PointCloud2View& a, std::size_t i, const PointCloud2View& b,
                    std::size_t j, const std::vector<std::string>& except) {
  const std::byte* const from = address_of(a, i);
  const std::byte* const to = address_of(b, j);
  for (std::size_t byte = 0; byte < a.point_step; ++byte) {
    const bool is_replaced = std::ranges::any_of(except, [&](const std::string& name) {
      const PointField* const field = b.find(name);
      return field != nullptr && byte >= field->offset && byte < field->offset + field->size();
    });
    if (!is_replaced && from[byte] != to[byte]) return false;
  }
  return true;
}

bool has_same_header(const PointCloud2View& a, const PointCloud2View& b) {
  return a.format == b.format && a.header == b.header && a.is_bigendian == b.is_bigendian &&
         a.is_dense == b.is_dense;
}

/// The fields of `a` without those names, in the same order with the same offsets, are the first
/// fields of `b` without those names.
bool keeps_fields(const PointCloud2View& a, const PointCloud2View& b,
                  const std::vector<std::string>& except) {
  const auto others = [&](const PointCloud2View& cloud) {
    std::vector<PointField> kept;
    for (const PointField& field : cloud.fields) {
      if (std::ranges::find(except, field.name) == except.end()) kept.push_back(field);
    }
    return kept;
  };
  return others(a) == others(b);
}

/// A number of a point in the byte order of this machine.
template <class T>
T number_of(const PointCloud2View& cloud, std::size_t i, std::string_view name) {
  const PointField* const field = cloud.find(name);
  RC_ASSERT(field != nullptr);
  RC_ASSERT(field->size() == sizeof(T));
  Bytes bytes(address_of(cloud, i) + field->offset,
              address_of(cloud, i) + field->offset + sizeof(T));
  if (cloud.is_bigendian) std::ranges::reverse(bytes);
  T value;
  std::memcpy(&value, bytes.data(), sizeof value);
  return value;
}

RC_GTEST_PROP(PointCloud2Property, MessagesSurviveARoundTripUnchanged, ()) {
  const Bytes message = random_message().bytes();
  PointCloud2View cloud;
  const Encoding encoding = message[0] == std::byte{0} && message[1] <= std::byte{1} &&
                                    parse(message, Encoding::cdr, cloud).ok()
                                ? Encoding::cdr
                                : Encoding::ros1;
  RC_ASSERT(parse(message, encoding, cloud).ok());
  Bytes again;
  RC_ASSERT(serialize(cloud, again).ok());
  RC_ASSERT(again == message);
}

RC_GTEST_PROP(PointCloud2Property, AppendedFieldsLeaveAllOthersUnchanged, ()) {
  const CloudMessage message = random_message();
  const Bytes bytes = message.bytes();
  PointCloud2View source;
  RC_ASSERT(parse(bytes, message.format.encoding, source).ok());
  const std::vector<Label> labels = random_labels(source.size());
  std::vector<float> heights(source.size());
  for (float& height : heights) height = static_cast<float>(random_number(1000)) / 8;
  const std::vector<AddedField> added{label_field(labels), height_field(heights)};
  DerivedCloud derived;
  Bytes out;

  RC_ASSERT(derived.append(source, added).ok());
  RC_ASSERT(derived.write_message(out).ok());

  PointCloud2View result;
  RC_ASSERT(parse(out, message.format.encoding, result).ok());
  RC_ASSERT(has_same_header(source, result));
  RC_ASSERT(result.height == source.height);
  RC_ASSERT(result.width == source.width);
  RC_ASSERT(result.rows_are_contiguous());
  RC_ASSERT(keeps_fields(source, result, {"label", "height"}));
  for (std::size_t i = 0; i < source.size(); ++i) {
    RC_ASSERT(has_same_point(source, i, result, i, {"label", "height"}));
    RC_ASSERT(number_of<Label>(result, i, "label") == labels[i]);
    RC_ASSERT(number_of<float>(result, i, "height") == heights[i]);
  }
}

RC_GTEST_PROP(PointCloud2Property, SelectionsPartitionThePoints, ()) {
  const CloudMessage message = random_message();
  const Bytes bytes = message.bytes();
  PointCloud2View source;
  RC_ASSERT(parse(bytes, message.format.encoding, source).ok());
  const std::vector<Label> labels = random_labels(source.size());
  std::size_t total = 0;
  for (std::uint8_t code = 0; code < label_count; ++code) {
    const auto label = static_cast<Label>(code);
    DerivedCloud derived;
    Bytes out;
    RC_ASSERT(derived.select(source, Selection(labels, {label})).ok());
    RC_ASSERT(derived.write_message(out).ok());
    PointCloud2View result;
    RC_ASSERT(parse(out, message.format.encoding, result).ok());
    RC_ASSERT(has_same_header(source, result));
    RC_ASSERT(result.fields == source.fields);
    RC_ASSERT(result.point_step == source.point_step);
    RC_ASSERT(result.height == 1U);
    std::size_t next = 0;
    for (std::size_t i = 0; i < source.size(); ++i) {
      if (labels[i] == label) RC_ASSERT(has_same_point(source, i, result, next++, {}));
    }
    RC_ASSERT(result.size() == next);
    total += next;
  }
  RC_ASSERT(total == source.size());
}

RC_GTEST_PROP(PointCloud2Property, CoordinatesDoNotDependOnPaddingAndByteOrder, ()) {
  using enum PointFieldType;
  CloudMessage message = random_message();
  message.is_bigendian = false;
  message.fields = {{"x", 1, float32, 1}, {"y", 5, float32, 1}, {"z", 9, float32, 1}};
  message.point_step = std::max<std::uint32_t>(message.point_step, 13);
  message.row_step = message.width * message.point_step;
  message.data = random_bytes(std::size_t{message.height} * message.row_step);
  CloudMessage other = message;
  other.is_bigendian = true;
  other.row_step += 5;
  other.data.clear();
  for (std::size_t row = 0; row < message.height; ++row) {
    for (std::size_t column = 0; column < message.width; ++column) {
      const auto point =
          std::span(message.data)
              .subspan(row * message.row_step + column * message.point_step, message.point_step);
      Bytes copy(point.begin(), point.end());
      for (const std::ptrdiff_t offset : {1, 5, 9}) {
        std::reverse(copy.begin() + offset, copy.begin() + offset + 4);
      }
      other.data.insert(other.data.end(), copy.begin(), copy.end());
    }
    other.data.resize(other.data.size() + 5);
  }
  const auto floats_of = [](const CloudMessage& from) {
    const Bytes bytes = from.bytes();
    PointCloud2View cloud;
    RC_ASSERT(parse(bytes, from.format.encoding, cloud).ok());
    std::vector<float> copy;
    CloudView points;
    RC_ASSERT(view_coordinates(cloud, copy, points).ok());
    RC_ASSERT(points.size() == cloud.size());
    Bytes floats;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Point point = points[i];
      const auto* const begin = reinterpret_cast<const std::byte*>(&point);
      floats.insert(floats.end(), begin, begin + sizeof point);
    }
    return floats;
  };
  RC_ASSERT(floats_of(message) == floats_of(other));
}

}  // namespace
}  // namespace flagstone::ros
