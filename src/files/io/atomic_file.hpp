// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string_view>

#include "flagstone/status.hpp"

namespace flagstone::io {

/// Writes a file atomically: writes a temporary file in the same directory and renames it to
/// `path`. On failure the temporary file is removed and an existing file stays unchanged. A
/// symbolic link is followed. A directory, device or pipe is an error, because renaming would
/// replace it. The directory must exist. There is no fsync: a crash of the program leaves no
/// partial file, but a loss of power may. unwritable with the path and the reason of the system,
/// out_of_memory. Never throws.
Status write_file(const std::filesystem::path& path, std::span<const std::byte> bytes);

/// As above, for text.
Status write_file(const std::filesystem::path& path, std::string_view text);

}  // namespace flagstone::io
