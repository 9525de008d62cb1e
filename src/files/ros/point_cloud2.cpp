// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "files/ros/point_cloud2.hpp"

#include <cstring>
#include <limits>
#include <utility>

#include "files/io/message.hpp"
#include "files/ros/serialization.hpp"

namespace flagstone::ros {
namespace {

using io::bad_byte;
using io::invalid;
using io::quote;

// A field has at least the length of its name, an offset, a type and a count.
constexpr std::size_t min_field_size = 4 + 4 + 1 + 4;

constexpr std::size_t max_uint32 = std::numeric_limits<std::uint32_t>::max();

Status read_field(MessageReader& reader, PointField& out) {
  if (Status status = reader.read_string("the name of a field", out.name); !status.ok()) {
    return status;
  }
  if (Status status = reader.read("the offset of a field", out.offset); !status.ok()) return status;
  std::uint8_t type = 0;
  if (Status status = reader.read("the datatype of a field", type); !status.ok()) return status;
  out.type = static_cast<PointFieldType>(type);
  return reader.read("the count of a field", out.count);
}

Status read_fields(MessageReader& reader, std::vector<PointField>& out) {
  std::uint32_t count = 0;
  if (Status status = reader.read("the number of fields", count); !status.ok()) return status;
  const std::size_t count_at = reader.offset() - sizeof count;
  if (count > reader.remaining() / min_field_size) {
    return bad_byte(count_at,
                    "{} fields do not fit in the remaining {} bytes (the message may be truncated, "
                    "of another type or in another encoding)",
                    count, reader.remaining());
  }
  if (count > max_point_fields) {
    return bad_byte(count_at, "the message has {} fields (expected at most {})", count,
                    max_point_fields);
  }
  out.resize(count);
  for (PointField& field : out) {
    if (Status status = read_field(reader, field); !status.ok()) return status;
  }
  return {};
}

/// Every field of a known type is within a point.
Status check_fields(const PointCloud2View& cloud) {
  for (const PointField& field : cloud.fields) {
    const std::size_t end = field.offset + field.size();
    if (field.size() > 0 && end > cloud.point_step) {
      return invalid("field {} ends at byte {} of a point (expected at most point_step, {})",
                     quote(field.name), end, cloud.point_step);
    }
  }
  return {};
}

/// Every point is within the data. There is at least one point.
Status check_points(const PointCloud2View& cloud) {
  if (cloud.point_step == 0 || cloud.point_stride() < cloud.point_step) {
    return invalid("point_step is {} (expected at least 1 for {} points)", cloud.point_step,
                   cloud.size());
  }
  const std::size_t row = (cloud.width - 1) * cloud.point_stride() + cloud.point_step;
  const std::size_t rows_before = cloud.height - 1;
  const std::size_t size = cloud.data.size();
  // Compared before they are multiplied, which could overflow.
  if (row > size || (rows_before > 0 && cloud.row_stride() > (size - row) / rows_before)) {
    return invalid(
        "the data has {} bytes, too few for height {} times width {} points (expected point_step "
        "{}, row_step {}; the message may be truncated)",
        size, cloud.height, cloud.width, cloud.point_step, cloud.row_step);
  }
  // With a row_step that is too small the rows are only known if nothing is between them.
  if (rows_before > 0 && cloud.row_step < row && size != rows_before * cloud.row_stride() + row) {
    return invalid(
        "row_step is {} (expected at least {}, width {} times point_step {}; or data of exactly "
        "height times width points)",
        cloud.row_step, row, cloud.width, cloud.point_step);
  }
  return {};
}

/// Reads the members in the order of the message. `points_at` and `fields_at` are the offsets of
/// height and of the fields.
Status read_members(MessageReader& reader, PointCloud2View& out, std::size_t& points_at,
                    std::size_t& fields_at) {
  if (Status status = reader.read_header(out.header); !status.ok()) return status;
  if (Status status = reader.read("height", out.height); !status.ok()) return status;
  points_at = reader.offset() - sizeof out.height;
  if (Status status = reader.read("width", out.width); !status.ok()) return status;
  fields_at = reader.offset();
  if (Status status = read_fields(reader, out.fields); !status.ok()) return status;
  if (Status status = reader.read_bool("is_bigendian", out.is_bigendian); !status.ok()) {
    return status;
  }
  if (Status status = reader.read("point_step", out.point_step); !status.ok()) return status;
  if (Status status = reader.read("row_step", out.row_step); !status.ok()) return status;
  std::uint32_t size = 0;
  if (Status status = reader.read("the size of the data", size); !status.ok()) return status;
  if (Status status = reader.read_bytes("data", size, out.data); !status.ok()) return status;
  if (Status status = reader.read_bool("is_dense", out.is_dense); !status.ok()) return status;
  return reader.check_end();
}

Status parse_members(std::span<const std::byte> message, Encoding encoding, PointCloud2View& out) {
  MessageReader reader;
  if (Status status = reader.open(message, encoding); !status.ok()) return status;
  out.format = reader.format();
  std::size_t points_at = 0;
  std::size_t fields_at = 0;
  if (Status status = read_members(reader, out, points_at, fields_at); !status.ok()) return status;
  if (out.size() == 0) return {};
  if (const Status status = check_points(out); !status.ok()) {
    return bad_byte(points_at, "{}", status.message());
  }
  if (const Status status = check_fields(out); !status.ok()) {
    return bad_byte(fields_at, "{}", status.message());
  }
  return {};
}

/// Writes or counts all members. Returns the offset of the data.
std::size_t write_members(const PointCloud2View& cloud, std::size_t data_size,
                          MessageWriter& writer) noexcept {
  writer.write_header(cloud.header);
  writer.write(cloud.height);
  writer.write(cloud.width);
  writer.write(static_cast<std::uint32_t>(cloud.fields.size()));
  for (const PointField& field : cloud.fields) {
    writer.write_string(field.name);
    writer.write(field.offset);
    writer.write(static_cast<std::uint8_t>(field.type));
    writer.write(field.count);
  }
  writer.write(std::uint8_t{cloud.is_bigendian});
  writer.write(cloud.point_step);
  writer.write(cloud.row_step);
  writer.write(static_cast<std::uint32_t>(data_size));
  const std::size_t data_at = writer.skip(data_size);
  writer.write(std::uint8_t{cloud.is_dense});
  return data_at;
}

/// The lengths fit in the members of a message.
Status check_lengths(const PointCloud2View& cloud) {
  if (cloud.fields.size() > max_point_fields) {
    return invalid("the cloud has {} fields (expected at most {})", cloud.fields.size(),
                   max_point_fields);
  }
  if (cloud.data.size() > max_uint32) {
    return invalid("the data has {} bytes (expected at most {})", cloud.data.size(), max_uint32);
  }
  bool names_fit = cloud.header.frame_id.size() < max_uint32;
  for (const PointField& field : cloud.fields) {
    names_fit = names_fit && field.name.size() < max_uint32;
  }
  if (!names_fit) return invalid("a name is longer than {} bytes", max_uint32 - 1);
  return {};
}

}  // namespace

void PointCloud2View::clear() noexcept {
  std::vector<PointField> kept = std::move(fields);
  kept.clear();
  *this = PointCloud2View();
  fields = std::move(kept);
}

Status parse(std::span<const std::byte> message, Encoding encoding, PointCloud2View& out) {
  out.clear();
  Status status = io::within_memory([&] { return parse_members(message, encoding, out); });
  if (!status.ok()) out.clear();
  return status;
}

Status check(const PointCloud2View& cloud) {
  return io::within_memory([&] {
    if (cloud.size() == 0) return Status();
    if (Status status = check_points(cloud); !status.ok()) return status;
    return check_fields(cloud);
  });
}

std::size_t serialized_size(const PointCloud2View& cloud, std::size_t data_size) noexcept {
  MessageWriter counter(cloud.format);
  static_cast<void>(write_members(cloud, data_size, counter));
  return counter.size();
}

std::span<std::byte> serialize_around(const PointCloud2View& cloud, std::size_t data_size,
                                      std::span<std::byte> message) noexcept {
  MessageWriter writer(cloud.format, message.data());
  return message.subspan(write_members(cloud, data_size, writer), data_size);
}

Status serialize(const PointCloud2View& cloud, std::vector<std::byte>& out) {
  return io::within_memory([&] {
    if (cloud.padded_point_step != 0) return invalid("the points are padded (copy them first)");
    if (Status status = check(cloud); !status.ok()) return status;
    if (Status status = check_lengths(cloud); !status.ok()) return status;
    out.resize(serialized_size(cloud, cloud.data.size()));
    const std::span<std::byte> data = serialize_around(cloud, cloud.data.size(), out);
    if (!data.empty()) std::memcpy(data.data(), cloud.data.data(), data.size());
    return Status();
  });
}

}  // namespace flagstone::ros
