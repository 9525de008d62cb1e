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

/// Reads a file that consists of little-endian 32-bit floats only: `floats_per_point` (3 to
/// max_fields) per point, x, y and z first. KITTI's .bin has 4, nuScenes' .pcd.bin has 5. bad_file,
/// invalid_argument, out_of_memory. Never throws; changes `out` only on success.
Status read_raw_points(std::span<const std::byte> bytes, std::size_t floats_per_point, Cloud& out);

/// As read_raw_points(), without copying: the bytes become the rows of the cloud.
Status adopt_raw_points(std::vector<std::byte> bytes, std::size_t floats_per_point, Cloud& out);

/// Writes the rows unchanged. invalid_argument if a field is not float32 or x, y and z are not the
/// first three fields; out_of_memory. Never throws.
Status write_raw_points(const Cloud& cloud, std::vector<std::byte>& out);

/// The point cloud formats, described in docs/reference/file-formats.md.
enum class CloudFormat {
  raw,  ///< 32-bit floats and nothing else
  pcd,
  ply,
  npy,
};

/// Options for files that do not describe themselves.
struct ReadOptions {
  /// Floats per point in raw files, 3 to max_fields. 0: 5 for .pcd.bin, otherwise 4.
  int columns = 0;
};

/// The format that belongs to the file extension, in upper or lower case: `.pcd.bin` and `.bin` are
/// raw; `.pcd`, `.ply` and `.npy`. Nothing for other extensions.
[[nodiscard]] std::optional<CloudFormat> format_of(const std::filesystem::path& path) noexcept;

/// Whether a file found in a directory is treated as a scan: its extension is known, it is not
/// hidden, and it is not a file of labels (`_lidarseg.bin`, `.label.npy`), heights (`.heights.npy`,
/// `.ground.npy`), a surface (`.surface.npy`) return kinds (`.return.npy`) or motions
/// (`.motion.npy`).
[[nodiscard]] bool is_scan_name(const std::filesystem::path& path) noexcept;

/// Reads a point cloud; the file extension determines the format. Never throws; changes `out` only
/// on success. An error message is one line, `PATH: byte OFFSET: PROBLEM (expected EXPECTED;
/// HINT)`, without the offset if the error has no position in the file. not_found, unreadable,
/// bad_file, invalid_argument (unknown extension, columns out of range), out_of_memory.
Status read_cloud(const std::filesystem::path& path, const ReadOptions& options, Cloud& out);

/// As read_cloud(), for bytes in memory; the message has no path.
Status parse_cloud(std::span<const std::byte> bytes, CloudFormat format,
                   std::size_t floats_per_point, Cloud& out);

/// Reads clouds into memory that it reuses. Once that memory has grown to the largest file, reading
/// raw points neither allocates nor copies. Not thread-safe: use one instance per thread.
class CloudReader {
 public:
  explicit CloudReader(const ReadOptions& options = {}) : options_(options) {}

  /// As read_cloud(), into cloud(). After a failure cloud() has no points and no fields.
  Status read(const std::filesystem::path& path);

  /// The cloud read last. Valid until the next read().
  [[nodiscard]] const Cloud& cloud() const noexcept { return cloud_; }

  /// Moves the cloud read last out of the reader.
  [[nodiscard]] Cloud release() noexcept { return std::exchange(cloud_, {}); }

  /// Size of the last file in bytes; 0 after a failure.
  [[nodiscard]] std::size_t file_size() const noexcept { return file_size_; }

 private:
  Status load(const std::filesystem::path& path);

  ReadOptions options_;
  Cloud cloud_;
  std::vector<std::byte> bytes_;  // of a file; moved into the cloud while that contains raw points
  std::size_t file_size_ = 0;
};

}  // namespace flagstone::io
