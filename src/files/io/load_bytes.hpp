// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

#include "flagstone/status.hpp"

namespace flagstone::io {

/// The largest file that is read.
inline constexpr std::size_t max_file_size = std::size_t{8} << 30U;

/// Reads a regular file whole; its size is asked first and nothing more is allocated. What memory
/// `out` has is used again where it suffices: handed in for one file after another, it grows to
/// the largest and then nothing is allocated. Folders, pipes, sockets and devices are refused
/// without waiting for them. A file that grows meanwhile is read as far as it was long, one that
/// shrinks is an error. not_found, unreadable, bad_file (above max_file_size), out_of_memory; the
/// message begins with the path. Never throws; on failure `out` is empty.
Status load_bytes(const std::filesystem::path& path, std::vector<std::byte>& out);

/// Asks the system to fetch a file that will be read soon, without waiting for it. Only a hint:
/// where the file cannot be opened nothing happens, load_bytes() will say why.
void read_ahead(const std::filesystem::path& path) noexcept;

}  // namespace flagstone::io
