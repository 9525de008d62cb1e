// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <vector>

#include "files/io/cloud.hpp"
#include "flagstone/status.hpp"

namespace flagstone::io {

/// Reads a NumPy array, format 1, 2 or 3, either N x 3 or more numbers of any integer or float type
/// (C or Fortran order), or N records with x, y and z among their fields; little or big endian.
/// bad_file with the byte offset and the reason, out_of_memory. Never throws; `out` is only changed
/// on success.
Status read_npy(std::span<const std::byte> bytes, Cloud& out);

/// Writes NumPy format 1.0 (2.0 where the header is long): N records with every field.
/// out_of_memory. Never throws.
Status write_npy(const Cloud& cloud, std::vector<std::byte>& out);

/// Writes a file of numbers, by rows, as many along each dimension as `shape` says: NumPy
/// format 1.0, float32. The file is there whole or not at all. invalid_argument where `values` are
/// not as many as the shape says, unwritable, out_of_memory. Never throws.
Status write_npy_file(const std::filesystem::path& path, std::span<const float> values,
                      std::span<const std::size_t> shape);

}  // namespace flagstone::io
