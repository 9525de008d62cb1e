// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "files/io/lzf.hpp"

#include <algorithm>
#include <cstring>

#include "files/io/message.hpp"

namespace flagstone::io {
namespace {

// A stream is a sequence of items. A control byte below 32 is followed by control + 1 literal
// bytes. Any other control byte refers back to bytes that are already expanded. Its high three bits
// are the length minus two; if they are 7, the next byte is added. Its low five bits and the last
// byte of the item are the distance minus one.
struct Item {
  bool is_literal;
  std::size_t length;    // bytes it expands to
  std::size_t distance;  // how far back a reference starts
  std::size_t size;      // bytes in the stream, including literal bytes
};

constexpr std::size_t first_reference = 32;
constexpr std::size_t long_reference = 7;

/// The item at `at`. If its `size` exceeds the rest of the stream, its other members are invalid.
Item item_at(std::span<const std::byte> stream, std::size_t at) noexcept {
  const auto byte_at = [&](std::size_t i) {
    return i < stream.size() ? std::to_integer<std::size_t>(stream[i]) : 0;
  };
  const std::size_t control = byte_at(at);
  if (control < first_reference) return {true, control + 1, 0, control + 2};
  std::size_t length = control >> 5U;
  std::size_t size = 2;
  if (length == long_reference) {
    length += byte_at(at + 1);
    size = 3;
  }
  const std::size_t distance = ((control & 31U) << 8U) + byte_at(at + size - 1) + 1;
  return {false, length + 2, distance, size};
}

void copy_reference(std::byte* to, std::size_t distance, std::size_t length) noexcept {
  const std::byte* const from = to - distance;
  if (distance >= length) {
    std::memcpy(to, from, length);
  } else {  // the ranges overlap: the reference repeats bytes that it writes
    for (std::size_t i = 0; i < length; ++i) to[i] = from[i];
  }
}

}  // namespace

Status measure_lzf(std::span<const std::byte> compressed, std::size_t file_offset,
                   std::size_t& expanded_size) {
  std::size_t expanded = 0;
  for (std::size_t at = 0; at < compressed.size();) {
    const Item item = item_at(compressed, at);
    if (item.size > compressed.size() - at) {
      return bad_byte(file_offset + at, "the compressed data ends within an item of {} bytes",
                      item.size);
    }
    if (item.distance > expanded) {
      return bad_byte(file_offset + at,
                      "the compressed data refers {} bytes back (expected at most {})",
                      item.distance, expanded);
    }
    expanded += item.length;
    at += item.size;
  }
  expanded_size = expanded;
  return {};
}

void expand_lzf(std::span<const std::byte> compressed, std::span<std::byte> out) noexcept {
  std::byte* to = out.data();
  for (std::size_t at = 0; at < compressed.size();) {
    const Item item = item_at(compressed, at);
    if (item.is_literal) {
      std::memcpy(to, compressed.data() + at + 1, item.length);
    } else {
      copy_reference(to, item.distance, item.length);
    }
    to += item.length;
    at += item.size;
  }
}

}  // namespace flagstone::io
