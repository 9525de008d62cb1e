// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "files/ros/livox_message.hpp"

#include <array>

#include "files/io/message.hpp"
#include "files/ros/serialization.hpp"

namespace flagstone::ros {
namespace {

// A CustomPoint: three bytes follow one uint32 and three float32.
constexpr std::uint32_t livox_point_size = 19;
// CDR aligns the uint32 at the start of the next point.
constexpr std::uint32_t livox_point_stride = 20;

constexpr std::array livox_fields{PointField{"offset_time", 0, PointFieldType::uint32, 1},
                                  PointField{"x", 4, PointFieldType::float32, 1},
                                  PointField{"y", 8, PointFieldType::float32, 1},
                                  PointField{"z", 12, PointFieldType::float32, 1},
                                  PointField{"reflectivity", 16, PointFieldType::uint8, 1},
                                  PointField{"tag", 17, PointFieldType::uint8, 1},
                                  PointField{"line", 18, PointFieldType::uint8, 1}};

Status read_points(MessageReader& reader, std::uint32_t point_num, PointCloud2View& out) {
  if (Status status = reader.read("the number of points", out.width); !status.ok()) return status;
  if (out.width != point_num) {
    return io::bad_byte(reader.offset() - sizeof point_num,
                        "the message has {} points, but point_num is {} (it may be of another type "
                        "or in another encoding)",
                        out.width, point_num);
  }
  if (out.width == 0) return {};
  const std::size_t size = (std::size_t{out.width} - 1) * out.point_stride() + out.point_step;
  return reader.read_bytes("points", size, out.data);
}

Status read_livox(std::span<const std::byte> message, Encoding encoding, PointCloud2View& out,
                  LivoxMessage& livox) {
  MessageReader reader;
  if (Status status = reader.open(message, encoding); !status.ok()) return status;
  out.format = reader.format();
  out.is_bigendian = reader.format().big_endian;
  out.height = 1;
  out.point_step = livox_point_size;
  if (encoding == Encoding::cdr) out.padded_point_step = livox_point_stride;
  out.is_dense = true;
  out.fields.assign(livox_fields.begin(), livox_fields.end());

  if (Status status = reader.read_header(out.header); !status.ok()) return status;
  if (Status status = reader.read("timebase", livox.timebase); !status.ok()) return status;
  std::uint32_t point_num = 0;
  if (Status status = reader.read("point_num", point_num); !status.ok()) return status;
  if (Status status = reader.read("lidar_id", livox.lidar_id); !status.ok()) return status;
  std::span<const std::byte> reserved;
  if (Status status = reader.read_bytes("rsvd", 3, reserved); !status.ok()) return status;
  if (Status status = read_points(reader, point_num, out); !status.ok()) return status;
  return reader.check_end();
}

}  // namespace

Status parse_livox(std::span<const std::byte> message, Encoding encoding, PointCloud2View& out,
                   LivoxMessage& livox) {
  out.clear();
  Status status = io::within_memory([&] { return read_livox(message, encoding, out, livox); });
  if (!status.ok()) out.clear();
  return status;
}

}  // namespace flagstone::ros
