// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "library/ground_map/state_bytes.hpp"

#include <string>

namespace flagstone {

std::uint64_t checksum(std::span<const std::byte> bytes) noexcept {
  std::uint64_t sum = 0xCBF29CE484222325U;
  for (const std::byte byte : bytes) {
    sum = (sum ^ std::to_integer<std::uint64_t>(byte)) * 0x100000001B3U;
  }
  return sum;
}

void StateWriter::start(std::string_view magic) {
  for (const char c : magic) bytes_.push_back(static_cast<std::byte>(c));
}

Status StateReader::open(std::string_view magic, std::string_view name) {
  const auto begins = [&](std::size_t count) {
    for (std::size_t k = 0; k < count; ++k) {
      if (bytes_[k] != static_cast<std::byte>(magic[k])) return false;
    }
    return true;
  };
  constexpr std::size_t without_version = 6;
  if (bytes_.size() < magic.size() || !begins(without_version)) {
    return bad_state(0, "not " + std::string(name), "bytes that flagstone saved");
  }
  if (!begins(magic.size())) {
    return bad_state(without_version, "another version of the format",
                     "version " + std::string(magic.substr(without_version)));
  }
  if (bytes_.size() < magic.size() + sizeof(std::uint64_t)) {
    return bad_state(bytes_.size(), "the checksum is missing", "all bytes that were saved");
  }
  const std::size_t end = bytes_.size() - sizeof(std::uint64_t);
  offset_ = end;
  if (read<std::uint64_t>() != checksum(bytes_.first(end))) {
    return bad_state(end, "the checksum differs", "the bytes as they were saved; they are damaged");
  }
  bytes_ = bytes_.first(end);
  offset_ = magic.size();
  return {};
}

Status bad_state(std::size_t offset, std::string_view problem, std::string_view expected) {
  return Status(StatusCode::bad_file, "byte " + std::to_string(offset) + ": " +
                                          std::string(problem) + " (expected " +
                                          std::string(expected) + ")");
}

}  // namespace flagstone
