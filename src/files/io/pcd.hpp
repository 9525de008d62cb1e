// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "files/io/cloud.hpp"
#include "flagstone/status.hpp"

namespace flagstone::io {

/// Reads a PCD file, version 0.6 or 0.7: ascii, binary or binary_compressed, with fields of any
/// order, type and count. bad_file with the byte offset and the reason, out_of_memory. Never
/// throws; changes `out` only on success.
Status read_pcd(std::span<const std::byte> bytes, Cloud& out);

/// Writes PCD 0.7, binary, with every field and padding unchanged. out_of_memory. Never throws.
Status write_pcd(const Cloud& cloud, std::vector<std::byte>& out);

}  // namespace flagstone::io
