// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <span>

#include "flagstone/status.hpp"

namespace flagstone::io {

/// The bytes of a file; not cleared before they are read, unlike a vector's.
class FileBytes {
 public:
  // NOLINTBEGIN(modernize-avoid-c-arrays): a length known at run time, not cleared
  FileBytes() = default;
  explicit FileBytes(std::size_t size)
      : bytes_(std::make_unique_for_overwrite<std::byte[]>(size)), size_(size) {}

  [[nodiscard]] std::span<const std::byte> span() const noexcept { return {bytes_.get(), size_}; }
  [[nodiscard]] std::span<std::byte> span() noexcept { return {bytes_.get(), size_}; }

 private:
  std::unique_ptr<std::byte[]> bytes_;
  // NOLINTEND(modernize-avoid-c-arrays)
  std::size_t size_ = 0;
};

/// The largest file that is read.
inline constexpr std::size_t max_file_size = std::size_t{8} << 30U;

/// Reads a regular file whole; its size is asked first and nothing more is allocated. Folders,
/// pipes, sockets and devices are refused without waiting for them. A file that grows meanwhile is
/// read as far as it was long, one that shrinks is an error. not_found, unreadable, bad_file (above
/// max_file_size), out_of_memory; the message begins with the path. Never throws; `out` is only
/// changed on success.
Status load_bytes(const std::filesystem::path& path, FileBytes& out);

}  // namespace flagstone::io
