// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>

namespace flagstone::tests {

/// Memory between two pages that cannot be read. Reading after its last byte, or before its first
/// page, stops the program.
class GuardedMemory {
 public:
  /// Throws std::bad_alloc.
  explicit GuardedMemory(std::size_t size);
  ~GuardedMemory();
  GuardedMemory(const GuardedMemory&) = delete;
  GuardedMemory& operator=(const GuardedMemory&) = delete;

  /// The last `size` bytes.
  [[nodiscard]] std::span<std::byte> last(std::size_t size) const {
    return {bytes_ + size_ - size, size};
  }

  /// The first `size` bytes, right after the page that cannot be read.
  [[nodiscard]] std::span<std::byte> first(std::size_t size) const { return {bytes_, size}; }

 private:
  std::byte* bytes_ = nullptr;  ///< between two pages that cannot be read
  std::size_t size_ = 0;        ///< whole pages
  std::size_t page_ = 0;
};

}  // namespace flagstone::tests
