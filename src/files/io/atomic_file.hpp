// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string_view>

#include "flagstone/status.hpp"

namespace flagstone::io {

/// Writes a file so that it is there whole or not at all: into a temporary name in the same folder,
/// then renamed onto `path`. On any failure the temporary is removed and an old file stays as it
/// was. A symbolic link is followed; anything else that is no regular file (folder, device, pipe)
/// is refused, since renaming would replace it. The folder must exist. The data is not forced to
/// the disk (no fsync): a crash of the program leaves no half file, a loss of power may. unwritable
/// with the path and the system's reason, out_of_memory. Never throws.
Status write_file(const std::filesystem::path& path, std::span<const std::byte> bytes);

/// The same for text.
Status write_file(const std::filesystem::path& path, std::string_view text);

}  // namespace flagstone::io
