// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "files/io/binary_rows.hpp"

#include "files/io/message.hpp"

namespace flagstone::io {

Status check_binary_rows(std::span<const std::byte> bytes, std::size_t offset, std::size_t points,
                         std::size_t stride, bool points_are_last) {
  const std::size_t left = bytes.size() - offset;
  if (points > left / stride) {
    return bad_byte(
        bytes.size(),
        "the header announces {} points of {} bytes, the {} bytes behind it hold {} (is "
        "the file cut off?)",
        points, stride, left, left / stride);
  }
  if (points_are_last && left / stride > points) {
    return bad_byte(
        offset + points * stride,
        "{} bytes after the {} points the header announces (correct the header's count)",
        left - points * stride, points);
  }
  return {};
}

}  // namespace flagstone::io
