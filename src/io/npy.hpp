// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "flagstone/status.hpp"
#include "io/cloud.hpp"

namespace flagstone::io {

/// Reads a NumPy array, format 1, 2 or 3, either N x 3 or more numbers of any integer or float type
/// (C or Fortran order), or N records with x, y and z among their fields; little or big endian.
/// bad_file with the byte offset and the reason, out_of_memory. Never throws; `out` is only changed
/// on success.
Status read_npy(std::span<const std::byte> bytes, Cloud& out);

/// Writes NumPy format 1.0 (2.0 where the header is long): N records with every field.
/// out_of_memory. Never throws.
Status write_npy(const Cloud& cloud, std::vector<std::byte>& out);

}  // namespace flagstone::io
