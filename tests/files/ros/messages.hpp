// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

#include "files/io/bytes.hpp"
#include "files/ros/point_cloud2.hpp"

/// Messages for tests and fuzzers, written member by member from the definitions of the messages,
/// without the code under test.
namespace flagstone::ros {

using io::Bytes;

/// Appends the members of a message.
class MessageBytes {
 public:
  explicit MessageBytes(MessageFormat format) : format_(format) {
    if (format.encoding == Encoding::ros1) return;
    bytes_ = {std::byte{0}, format.big_endian ? std::byte{0} : std::byte{1}, std::byte{0},
              std::byte{0}};
  }

  template <class T>
  MessageBytes& add(T value) {
    if (format_.encoding == Encoding::cdr) {
      while ((bytes_.size() - 4) % sizeof(T) != 0) bytes_.push_back(std::byte{0});
    }
    std::vector<std::byte> bytes(sizeof(T));
    std::memcpy(bytes.data(), &value, sizeof(T));
    if (format_.big_endian) std::reverse(bytes.begin(), bytes.end());
    return add_bytes(bytes);
  }

  MessageBytes& add_string(std::string_view text) {
    const bool is_cdr = format_.encoding == Encoding::cdr;
    add(static_cast<std::uint32_t>(text.size() + (is_cdr ? 1 : 0)));
    add_bytes(io::bytes_of(text));
    return is_cdr ? add_bytes(Bytes(1)) : *this;
  }

  MessageBytes& add_bytes(const Bytes& bytes) {
    bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
    return *this;
  }

  MessageBytes& add_header(std::uint32_t seq, std::uint32_t sec, std::uint32_t nanosec,
                           std::string_view frame_id) {
    if (format_.encoding == Encoding::ros1) add(seq);
    return add(sec).add(nanosec).add_string(frame_id);
  }

  [[nodiscard]] const Bytes& bytes() const { return bytes_; }

 private:
  MessageFormat format_;
  Bytes bytes_;
};

/// The formats that exist.
inline const std::vector<MessageFormat> all_formats{
    {Encoding::cdr, false}, {Encoding::cdr, true}, {Encoding::ros1, false}};

/// The members of a PointCloud2.
struct CloudMessage {
  MessageFormat format;
  std::uint32_t seq = 7;
  std::uint32_t sec = 1700000000;
  std::uint32_t nanosec = 123456789;
  std::string frame_id = "lidar";
  std::uint32_t height = 1;
  std::uint32_t width = 0;
  std::vector<PointField> fields;
  bool is_bigendian = false;
  std::uint32_t point_step = 0;
  std::uint32_t row_step = 0;
  Bytes data;
  bool is_dense = true;

  [[nodiscard]] Bytes bytes() const {
    MessageBytes message(format);
    message.add_header(seq, sec, nanosec, frame_id).add(height).add(width);
    message.add(static_cast<std::uint32_t>(fields.size()));
    for (const PointField& field : fields) {
      message.add_string(field.name).add(field.offset);
      message.add(static_cast<std::uint8_t>(field.type)).add(field.count);
    }
    message.add(static_cast<std::uint8_t>(is_bigendian)).add(point_step).add(row_step);
    message.add(static_cast<std::uint32_t>(data.size())).add_bytes(data);
    return message.add(static_cast<std::uint8_t>(is_dense)).bytes();
  }
};

/// Two points with x, y, z, intensity and ring, as velodyne_pointcloud publishes them without time.
inline CloudMessage small_message(MessageFormat format = {}) {
  using enum PointFieldType;
  CloudMessage message;
  message.format = format;
  message.width = 2;
  message.fields = {{"x", 0, float32, 1},
                    {"y", 4, float32, 1},
                    {"z", 8, float32, 1},
                    {"intensity", 12, float32, 1},
                    {"ring", 16, uint16, 1}};
  message.point_step = 18;
  message.row_step = 36;
  message.data =
      io::joined({io::numbers({1.F, 2.F, 3.F, 40.F}), io::numbers<std::uint16_t>({5}),
                  io::numbers({-1.F, -2.F, -3.F, 50.F}), io::numbers<std::uint16_t>({6})});
  return message;
}

/// A CustomMsg of Livox with `count` points: x = 1, 2, ..., y = 0.5, z = -1.
inline Bytes livox_message(MessageFormat format, std::uint32_t count) {
  MessageBytes message(format);
  message.add_header(3, 1700000000, 5, "livox_frame").add(std::uint64_t{1700000000000000005});
  message.add(count).add(std::uint8_t{192}).add_bytes(Bytes(3)).add(count);
  for (std::uint32_t i = 0; i < count; ++i) {
    message.add(i * 1000).add(static_cast<float>(i + 1)).add(0.5F).add(-1.F);
    message.add(static_cast<std::uint8_t>(100 + i)).add(std::uint8_t{16});
    message.add(static_cast<std::uint8_t>(i % 4));
  }
  return message.bytes();
}

}  // namespace flagstone::ros
