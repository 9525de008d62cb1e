// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string_view>

#include "files/ros/point_cloud2.hpp"
#include "flagstone/status.hpp"

/// Reading and writing the members of messages; internal to this directory.
namespace flagstone::ros {

/// Size of the encapsulation header of CDR. Members are aligned relative to its end.
inline constexpr std::size_t encapsulation_size = 4;

/// `value` with its bytes reversed.
template <std::unsigned_integral T>
constexpr T reversed(T value) noexcept {
  std::uint64_t result = 0;
  for (std::size_t i = 0; i < sizeof(T); ++i) {
    result = (result << 8U) | ((std::uint64_t{value} >> (8U * i)) & 0xffU);
  }
  return static_cast<T>(result);
}

/// Reads the members of a message in order. Each function returns bad_file with a byte offset if
/// the message ends before the member; `name` is the member for the message.
class MessageReader {
 public:
  /// Reads the encapsulation header of CDR.
  Status open(std::span<const std::byte> message, Encoding encoding);

  [[nodiscard]] const MessageFormat& format() const noexcept { return format_; }

  /// Offset of the next unread byte.
  [[nodiscard]] std::size_t offset() const noexcept { return offset_; }

  [[nodiscard]] std::size_t remaining() const noexcept { return message_.size() - offset_; }

  template <std::unsigned_integral T>
  Status read(std::string_view name, T& out) {
    align(sizeof(T));
    if (remaining() < sizeof(T)) return truncated(name, sizeof(T));
    std::memcpy(&out, message_.data() + offset_, sizeof(T));
    if (format_.big_endian) out = reversed(out);
    offset_ += sizeof(T);
    return {};
  }

  /// A boolean, which must be 0 or 1.
  Status read_bool(std::string_view name, bool& out);

  /// A string, without copying.
  Status read_string(std::string_view name, std::string_view& out);

  /// `size` bytes, without copying.
  Status read_bytes(std::string_view name, std::size_t size, std::span<const std::byte>& out);

  Status read_header(Header& out);

  /// Moves to the next multiple of `size`, or to the end of the message.
  void align(std::size_t size) noexcept;

  /// bad_file if more than the padding of CDR, 3 bytes, follows.
  [[nodiscard]] Status check_end() const;

 private:
  [[nodiscard]] Status truncated(std::string_view name, std::size_t expected) const;

  std::span<const std::byte> message_;
  MessageFormat format_;
  std::size_t offset_ = 0;
};

/// Writes the members of a message in order, or only counts their bytes.
class MessageWriter {
 public:
  /// Counts only.
  explicit MessageWriter(MessageFormat format) noexcept : MessageWriter(format, nullptr) {}

  /// Writes to `to`, which must have the bytes that the other constructor counts.
  MessageWriter(MessageFormat format, std::byte* to) noexcept;

  [[nodiscard]] std::size_t size() const noexcept { return offset_; }

  template <std::unsigned_integral T>
  void write(T value) noexcept {
    if (format_.encoding == Encoding::cdr) align(sizeof(T));
    if (to_ != nullptr) {
      if (format_.big_endian) value = reversed(value);
      std::memcpy(to_ + offset_, &value, sizeof value);
    }
    offset_ += sizeof value;
  }

  void write_string(std::string_view text) noexcept;
  void write_header(const Header& header) noexcept;

  /// Leaves `size` bytes unwritten; returns their offset.
  std::size_t skip(std::size_t size) noexcept {
    offset_ += size;
    return offset_ - size;
  }

 private:
  void align(std::size_t size) noexcept;

  MessageFormat format_;
  std::byte* to_;
  std::size_t offset_ = 0;
};

}  // namespace flagstone::ros
