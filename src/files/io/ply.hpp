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
/// before the vertices are skipped, and elements after them are not read. A list property of the
/// vertices is an error. bad_file with the byte offset and the reason, out_of_memory. Never throws;
/// changes `out` only on success.
Status read_ply(std::span<const std::byte> bytes, Cloud& out);

/// Writes PLY 1.0, binary_little_endian, with one element, `vertex`. A field of several numbers
/// becomes the properties name_0, name_1, ...; padding is omitted. PLY has no 64-bit integers, so
/// they become double. invalid_argument if this would change a value, if two properties would have
/// the same name, or if there would be more than max_fields properties; out_of_memory. Never
/// throws.
Status write_ply(const Cloud& cloud, std::vector<std::byte>& out);

}  // namespace flagstone::io
