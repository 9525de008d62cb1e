// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>

#include "files/io/cloud.hpp"
#include "flagstone/status.hpp"

namespace flagstone::io {

/// The point cloud formats. docs/formats.md says what each may hold.
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

}  // namespace flagstone::io
