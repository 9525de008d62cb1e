// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "files/io/cloud.hpp"
#include "flagstone/status.hpp"

namespace flagstone::io {

/// Reads the vertices of a PLY file: ascii, binary_little_endian or binary_big_endian. Elements
/// before them are skipped, elements behind them not looked at; a list in the vertices is an error.
/// bad_file with the byte offset and the reason, out_of_memory. Never throws; `out` is only changed
/// on success.
Status read_ply(std::span<const std::byte> bytes, Cloud& out);

/// Writes PLY 1.0, binary_little_endian, one element \`vertex\`. A field of more than one number
/// becomes properties name_0, name_1, ...; padding is left out; 64-bit integers, which PLY does not
/// have, become double where no value changes by it. invalid_argument where one would, where two
/// properties would have one name, or where there would be more than max_fields. out_of_memory.
/// Never throws.
Status write_ply(const Cloud& cloud, std::vector<std::byte>& out);

}  // namespace flagstone::io
