// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

#include "flagstone/status.hpp"

namespace flagstone::io {

/// The largest file that load_bytes() reads, bytes.
inline constexpr std::size_t max_file_size = std::size_t{8} << 30U;

/// Reads all bytes of a regular file. Allocates exactly the size of the file, and nothing if the
/// capacity of `out` suffices, so pass the same vector for many files. Directories, pipes, sockets
/// and devices are errors; opening them never blocks. If the file grows during reading, the result
/// has the size from before; if it shrinks, that is an error. not_found, unreadable, bad_file
/// (above max_file_size), out_of_memory; the message begins with the path. Never throws; on failure
/// `out` is empty.
Status load_bytes(const std::filesystem::path& path, std::vector<std::byte>& out);

/// Prefetches a file that will be read soon, without waiting. This is only a hint: if the file
/// cannot be opened, nothing happens, and load_bytes() reports the reason later.
void read_ahead(const std::filesystem::path& path) noexcept;

}  // namespace flagstone::io
