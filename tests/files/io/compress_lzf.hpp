// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

namespace flagstone::io {

/// An LZF stream that expands to `bytes`. A simple compressor for tests and fuzzers, which searches
/// the whole window for the longest match. The library itself only expands.
inline std::vector<std::byte> compress_lzf(std::span<const std::byte> bytes) {
  constexpr std::size_t longest_literal = 32;
  constexpr std::size_t longest_match = 264;
  constexpr std::size_t farthest = 8192;
  std::vector<std::byte> out;
  std::vector<std::byte> literal;
  const auto put = [&](std::size_t value) { out.push_back(static_cast<std::byte>(value)); };
  const auto flush = [&] {
    if (literal.empty()) return;
    put(literal.size() - 1);
    out.insert(out.end(), literal.begin(), literal.end());
    literal.clear();
  };
  for (std::size_t at = 0; at < bytes.size();) {
    std::size_t length = 0;
    std::size_t distance = 0;
    const std::size_t limit = std::min(longest_match, bytes.size() - at);
    for (std::size_t back = 1; back <= std::min(at, farthest) && length < limit; ++back) {
      std::size_t match = 0;
      while (match < limit && bytes[at - back + match] == bytes[at + match]) ++match;
      if (match > length) {
        length = match;
        distance = back;
      }
    }
    if (length < 3) {
      literal.push_back(bytes[at++]);
      if (literal.size() == longest_literal) flush();
      continue;
    }
    flush();
    const std::size_t code = length - 2;
    put((std::min<std::size_t>(code, 7) << 5U) | ((distance - 1) >> 8U));
    if (code >= 7) put(code - 7);
    put((distance - 1) & 0xffU);
    at += length;
  }
  flush();
  return out;
}

}  // namespace flagstone::io
