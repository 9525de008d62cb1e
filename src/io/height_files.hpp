// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <vector>

#include "flagstone/status.hpp"

namespace flagstone::io {

/// Writes one height a point, metres, as a NumPy array, N x float32; NaN where none is known. The
/// file is there whole or not at all. unwritable, out_of_memory. Never throws.
Status write_height_file(const std::filesystem::path& path, std::span<const float> heights);

/// Bytes of such a file. Throws std::bad_alloc.
std::size_t height_file_size(std::size_t points);

/// Reads such an array. `expected_points` is the size of the scan the file belongs to; any other
/// number of heights is an error that names both. not_found, unreadable, bad_file, out_of_memory.
/// Never throws; `heights` is only changed on success.
Status read_height_file(const std::filesystem::path& path, std::size_t expected_points,
                        std::vector<float>& heights);

}  // namespace flagstone::io
