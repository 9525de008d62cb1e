// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "files/io/cloud.hpp"
#include "flagstone/status.hpp"

namespace flagstone::io {

/// Reads points that are `floats_per_point` (3 to max_fields) little-endian 32-bit floats each and
/// nothing else, x, y and z first: KITTI's .bin with 4, nuScenes' .pcd.bin with 5.
/// bad_file, invalid_argument, out_of_memory. Never throws; `out` is only changed on success.
Status read_raw_points(std::span<const std::byte> bytes, std::size_t floats_per_point, Cloud& out);

/// The same without a copy: the bytes become the cloud's rows.
Status adopt_raw_points(std::vector<std::byte> bytes, std::size_t floats_per_point, Cloud& out);

/// Writes the rows as they are. invalid_argument where a field is not a float32 or x, y and z are
/// not the first three; out_of_memory. Never throws.
Status write_raw_points(const Cloud& cloud, std::vector<std::byte>& out);

/// The point cloud formats. docs/reference/file-formats.md says what each may hold.
enum class CloudFormat {
  raw,  ///< 32-bit floats and nothing else
  pcd,
  ply,
  npy,
};

/// What a reader is told beyond the file.
struct ReadOptions {
  int columns = 0;  ///< floats a point in raw files, 3 to max_fields; 0: 5 for .pcd.bin, else 4
};

/// The format a file name stands for, by its ending in any case: `.pcd.bin` and `.bin` are raw,
/// `.pcd`, `.ply`, `.npy`; nothing for other names.
[[nodiscard]] std::optional<CloudFormat> format_of(const std::filesystem::path& path) noexcept;

/// Whether a file met while walking a folder is taken for a scan: the name stands for a format, is
/// not hidden, and is not that of a label file (`_lidarseg.bin`, `.label.npy`), of heights or of a
/// surface (`.heights.npy`, `.surface.npy`, `.ground.npy`).
[[nodiscard]] bool is_scan_name(const std::filesystem::path& path) noexcept;

/// Reads a point cloud; the name says the format. Never throws. `out` is only changed on success.
/// The message of an error is one line, `PATH: byte OFFSET: reason (what is allowed, what to do)`,
/// without the offset where no byte of the file is to blame. not_found, unreadable, bad_file,
/// invalid_argument (unknown ending, columns out of range), out_of_memory.
Status read_cloud(const std::filesystem::path& path, const ReadOptions& options, Cloud& out);

/// The same for bytes in memory; the message has no path.
Status parse_cloud(std::span<const std::byte> bytes, CloudFormat format,
                   std::size_t floats_per_point, Cloud& out);

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
