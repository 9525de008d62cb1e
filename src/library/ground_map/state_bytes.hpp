// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "flagstone/status.hpp"

namespace flagstone {

/// Detects damaged bytes: FNV-1a with 64 bits.
std::uint64_t checksum(std::span<const std::byte> bytes) noexcept;

/// Appends numbers to bytes, little-endian. May throw std::bad_alloc.
class StateWriter {
 public:
  explicit StateWriter(std::vector<std::byte>& bytes) noexcept : bytes_(bytes) {}

  void add(std::unsigned_integral auto number) {
    for (std::size_t k = 0; k < sizeof number; ++k) {
      bytes_.push_back(static_cast<std::byte>(std::uint64_t{number} >> (8 * k) & 0xFFU));
    }
  }
  void add(std::int64_t number) { add(static_cast<std::uint64_t>(number)); }
  void add(std::int32_t number) { add(static_cast<std::uint32_t>(number)); }
  void add(float number) { add(std::bit_cast<std::uint32_t>(number)); }
  void add(double number) { add(std::bit_cast<std::uint64_t>(number)); }

  /// Starts a state: 8 characters, its kind and version.
  void start(std::string_view magic);
  /// Ends a state with the checksum of everything before.
  void finish() { add(checksum(bytes_)); }

 private:
  std::vector<std::byte>& bytes_;
};

/// Reads numbers from bytes. Beyond the end, numbers are 0 and failed() is true.
class StateReader {
 public:
  explicit StateReader(std::span<const std::byte> bytes) noexcept : bytes_(bytes) {}

  template <class Number>
  Number read() noexcept {
    if constexpr (std::same_as<Number, float>) {
      return std::bit_cast<float>(read<std::uint32_t>());
    } else if constexpr (std::same_as<Number, double>) {
      return std::bit_cast<double>(read<std::uint64_t>());
    } else {
      if (left() < sizeof(Number)) failed_ = true;
      if (failed_) return 0;
      std::uint64_t number = 0;
      for (std::size_t k = 0; k < sizeof(Number); ++k) {
        number |= std::to_integer<std::uint64_t>(bytes_[offset_ + k]) << (8 * k);
      }
      offset_ += sizeof(Number);
      return static_cast<Number>(number);
    }
  }

  /// Checks the first 8 characters and the checksum, which is then not part of the bytes any more.
  /// bad_file if one of them is wrong.
  Status open(std::string_view magic, std::string_view name);

  [[nodiscard]] bool failed() const noexcept { return failed_; }
  [[nodiscard]] std::size_t offset() const noexcept { return offset_; }
  [[nodiscard]] std::size_t left() const noexcept { return bytes_.size() - offset_; }

 private:
  std::span<const std::byte> bytes_;
  std::size_t offset_ = 0;
  bool failed_ = false;
};

/// bad_file: "byte OFFSET: PROBLEM (expected EXPECTED)".
Status bad_state(std::size_t offset, std::string_view problem, std::string_view expected);

}  // namespace flagstone
