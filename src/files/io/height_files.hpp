// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

#include "flagstone/status.hpp"

namespace flagstone::io {

/// Reads one height a point, metres, as write_npy_file() writes them: a NumPy array, N x float32;
/// NaN where none is known. `expected_points` is the size of the scan the file belongs to; any
/// other number of heights is an error that names both. not_found, unreadable, bad_file,
/// out_of_memory. Never throws; `heights` is only changed on success.
Status read_height_file(const std::filesystem::path& path, std::size_t expected_points,
                        std::vector<float>& heights);

/// Bytes of such a file. Throws std::bad_alloc.
std::size_t height_file_size(std::size_t points);

}  // namespace flagstone::io
