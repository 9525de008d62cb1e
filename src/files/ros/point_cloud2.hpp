// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "files/ros/point_field.hpp"
#include "flagstone/status.hpp"

namespace flagstone::ros {

/// How the bytes of a message represent its members. A message does not contain this choice: in a
/// ROS 1 bag it is `ros1`; in rosbag2, MCAP (encoding `cdr`) and raw subscriptions of ROS 2 it is
/// `cdr`.
enum class Encoding : std::uint8_t {
  cdr,   ///< ROS 2: OMG CDR (XCDR1) after an encapsulation header of 4 bytes
  ros1,  ///< ROS 1: little-endian, without alignment, with a sequence number in the header
};

/// How a message was serialized. Messages derived from it use the same format.
struct MessageFormat {
  Encoding encoding = Encoding::cdr;
  bool big_endian = false;  ///< of the message, not of its points; always false for ros1

  friend bool operator==(const MessageFormat&, const MessageFormat&) = default;
};

/// std_msgs/Header.
struct Header {
  std::uint32_t seq = 0;  ///< sequence number; ROS 1 only
  std::int64_t sec = 0;   ///< of the time stamp: int32 in ROS 2, uint32 in ROS 1
  std::uint32_t nanosec = 0;
  std::string_view frame_id;

  friend bool operator==(const Header&, const Header&) = default;
};

/// The most fields of a message.
inline constexpr std::size_t max_point_fields = 1024;

/// A sensor_msgs/PointCloud2, or the points of another message as one. Names and data are views of
/// the message's bytes, which must outlive it. Parsing into the same object again reuses the memory
/// of `fields`. Can be read from several threads at once.
struct PointCloud2View {
  MessageFormat format;
  Header header;
  std::uint32_t height = 0;  ///< rows; 1 if the cloud is not organized
  std::uint32_t width = 0;   ///< points per row
  std::vector<PointField> fields;
  bool is_bigendian = false;     ///< byte order of the numbers in `data`
  std::uint32_t point_step = 0;  ///< size of a point in bytes
  std::uint32_t row_step = 0;    ///< distance between rows in bytes, as the message specifies it
  std::span<const std::byte> data;
  bool is_dense = false;  ///< whether all points are valid

  /// Distance between points in bytes, if it is not point_step. Not a member of the message: the
  /// points of a Livox CustomMsg are padded between them, but not after the last one.
  std::uint32_t padded_point_step = 0;

  /// Number of points.
  [[nodiscard]] std::size_t size() const noexcept { return std::size_t{height} * width; }

  /// Distance between points in bytes.
  [[nodiscard]] std::size_t point_stride() const noexcept {
    return padded_point_step != 0 ? padded_point_step : point_step;
  }

  /// Distance between rows in bytes. If row_step is less than a row, the rows are contiguous.
  [[nodiscard]] std::size_t row_stride() const noexcept {
    const std::size_t contiguous = width * point_stride();
    return row_step < contiguous ? contiguous : row_step;
  }

  /// Whether the distance between all consecutive points is point_stride().
  [[nodiscard]] bool rows_are_contiguous() const noexcept {
    return height <= 1 || row_stride() == width * point_stride();
  }

  /// The first field of this name, or null.
  [[nodiscard]] const PointField* find(std::string_view name) const noexcept {
    return ros::find(fields, name);
  }

  /// Removes all fields and points. Keeps the memory of the fields.
  void clear() noexcept;
};

/// Reads a serialized sensor_msgs/PointCloud2 without copying its data. Allocates only memory for
/// the fields, at most max_point_fields, and nothing if the capacity of `out.fields` suffices.
///
/// bad_file with "byte OFFSET: ..." if the message is truncated, contradicts itself, or is not a
/// PointCloud2; out_of_memory. On failure `out` has no fields and no points. Never throws.
///
/// After success every field of a known type is within point_step, and every point is within
/// `data`. Fields of unknown types and x, y and z are not checked further: see view_coordinates().
Status parse(std::span<const std::byte> message, Encoding encoding, PointCloud2View& out);

/// Checks a view that was not made by parse(), for example of a message that a ROS client library
/// has deserialized: the guarantees of parse(). invalid_argument.
Status check(const PointCloud2View& cloud);

/// Number of bytes of the serialized message if its data has `data_size` bytes. `cloud.data` and
/// `cloud.padded_point_step` are ignored.
[[nodiscard]] std::size_t serialized_size(const PointCloud2View& cloud,
                                          std::size_t data_size) noexcept;

/// Serializes everything except the data into `message`, which must have
/// serialized_size(cloud, data_size) bytes. Returns the part of `message` for the data, which is
/// not written.
[[nodiscard]] std::span<std::byte> serialize_around(const PointCloud2View& cloud,
                                                    std::size_t data_size,
                                                    std::span<std::byte> message) noexcept;

/// Serializes a message, in `cloud.format`, with its data unchanged. invalid_argument if check()
/// fails, if padded_point_step is not 0, or if the data or a name is longer than 4 GiB;
/// out_of_memory. Never throws.
Status serialize(const PointCloud2View& cloud, std::vector<std::byte>& out);

}  // namespace flagstone::ros
