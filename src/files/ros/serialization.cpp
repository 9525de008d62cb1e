// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "files/ros/serialization.hpp"

#include <algorithm>

#include "files/io/message.hpp"

namespace flagstone::ros {

using io::bad_byte;

Status MessageReader::open(std::span<const std::byte> message, Encoding encoding) {
  message_ = message;
  format_ = {.encoding = encoding, .big_endian = false};
  offset_ = 0;
  if (encoding == Encoding::ros1) return {};
  if (message.size() < encapsulation_size) return truncated("encapsulation header", 4);
  const auto kind =
      std::to_integer<unsigned>(message[0]) << 8U | std::to_integer<unsigned>(message[1]);
  if (kind > 1) {
    return bad_byte(0,
                    "CDR encapsulation 0x{:04x} is not supported (expected 0x0000 or 0x0001, plain "
                    "CDR; messages in ROS 1 bags need the encoding ros1)",
                    kind);
  }
  format_.big_endian = kind == 0;
  offset_ = encapsulation_size;
  return {};
}

void MessageReader::align(std::size_t size) noexcept {
  if (format_.encoding == Encoding::ros1) return;
  offset_ = std::min(message_.size(), offset_ + (encapsulation_size - offset_) % size);
}

Status MessageReader::truncated(std::string_view name, std::size_t expected) const {
  return bad_byte(offset_,
                  "the message ends within {} ({} bytes remain, expected {}; it may be truncated, "
                  "of another type or in another encoding)",
                  name, remaining(), expected);
}

Status MessageReader::read_bool(std::string_view name, bool& out) {
  std::uint8_t value = 0;
  if (Status status = read(name, value); !status.ok()) return status;
  if (value > 1) {
    return bad_byte(offset_ - 1,
                    "{} is {} (expected 0 or 1; the message may be of another type or in another "
                    "encoding)",
                    name, value);
  }
  out = value == 1;
  return {};
}

Status MessageReader::read_bytes(std::string_view name, std::size_t size,
                                 std::span<const std::byte>& out) {
  if (remaining() < size) return truncated(name, size);
  out = message_.subspan(offset_, size);
  offset_ += size;
  return {};
}

Status MessageReader::read_string(std::string_view name, std::string_view& out) {
  std::uint32_t size = 0;
  if (Status status = read(name, size); !status.ok()) return status;
  std::span<const std::byte> bytes;
  if (Status status = read_bytes(name, size, bytes); !status.ok()) return status;
  out = {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
  if (format_.encoding == Encoding::ros1 || out.empty()) return {};
  if (out.back() != '\0') {
    return bad_byte(offset_ - 1, "{} has no null character at its end (CDR requires one)", name);
  }
  out.remove_suffix(1);
  return {};
}

Status MessageReader::read_header(Header& out) {
  if (format_.encoding == Encoding::ros1) {
    if (Status status = read("header.seq", out.seq); !status.ok()) return status;
  }
  std::uint32_t sec = 0;
  if (Status status = read("header.stamp.sec", sec); !status.ok()) return status;
  out.sec = format_.encoding == Encoding::ros1 ? std::int64_t{sec}
                                               : std::int64_t{static_cast<std::int32_t>(sec)};
  if (Status status = read("header.stamp.nanosec", out.nanosec); !status.ok()) return status;
  return read_string("header.frame_id", out.frame_id);
}

Status MessageReader::check_end() const {
  constexpr std::size_t max_padding = 3;
  const std::size_t padding = format_.encoding == Encoding::cdr ? max_padding : 0;
  if (remaining() <= padding) return {};
  return bad_byte(offset_,
                  "{} bytes follow the last member of the message (expected at most {}; it may be "
                  "of another type or in another encoding)",
                  remaining(), padding);
}

MessageWriter::MessageWriter(MessageFormat format, std::byte* to) noexcept
    : format_(format), to_(to) {
  if (format.encoding == Encoding::ros1) {
    format_.big_endian = false;
    return;
  }
  offset_ = encapsulation_size;
  if (to_ == nullptr) return;
  std::memset(to_, 0, encapsulation_size);
  to_[1] = std::byte{format.big_endian ? std::uint8_t{0} : std::uint8_t{1}};
}

void MessageWriter::align(std::size_t size) noexcept {
  const std::size_t padding = (encapsulation_size - offset_) % size;
  if (to_ != nullptr) std::memset(to_ + offset_, 0, padding);
  offset_ += padding;
}

void MessageWriter::write_string(std::string_view text) noexcept {
  const bool has_null = format_.encoding == Encoding::cdr;
  write(static_cast<std::uint32_t>(text.size() + (has_null ? 1 : 0)));
  if (to_ != nullptr) {
    if (!text.empty()) std::memcpy(to_ + offset_, text.data(), text.size());
    if (has_null) to_[offset_ + text.size()] = std::byte{0};
  }
  offset_ += text.size() + (has_null ? 1 : 0);
}

void MessageWriter::write_header(const Header& header) noexcept {
  if (format_.encoding == Encoding::ros1) write(header.seq);
  write(static_cast<std::uint32_t>(header.sec));
  write(header.nanosec);
  write_string(header.frame_id);
}

}  // namespace flagstone::ros
