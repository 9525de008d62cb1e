// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>
#include <utility>
#include <vector>

#include "files/io/cloud.hpp"
#include "files/io/read_cloud.hpp"
#include "flagstone/status.hpp"

namespace flagstone::io {

/// Reads one cloud after another into memory that it keeps: once that has grown to the largest
/// file, raw points are read where they stay and nothing is allocated for them. One per thread.
class CloudReader {
 public:
  explicit CloudReader(const ReadOptions& options = {}) : options_(options) {}

  /// As read_cloud(), into cloud(), which has no points and no fields after a failure.
  Status read(const std::filesystem::path& path);

  /// What was read last. Valid until the next read().
  [[nodiscard]] const Cloud& cloud() const noexcept { return cloud_; }

  /// The same, to keep.
  [[nodiscard]] Cloud release() noexcept { return std::exchange(cloud_, {}); }

  /// How many bytes the last file had; 0 after a failure.
  [[nodiscard]] std::size_t file_size() const noexcept { return file_size_; }

 private:
  Status load(const std::filesystem::path& path);

  ReadOptions options_;
  Cloud cloud_;
  std::vector<std::byte> bytes_;  // of a file; lent to the cloud while that holds raw points
  std::size_t file_size_ = 0;
};

}  // namespace flagstone::io
