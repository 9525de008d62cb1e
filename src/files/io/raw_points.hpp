// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "files/io/cloud.hpp"
#include "flagstone/status.hpp"

namespace flagstone::io {

/// Reads points that are `floats_per_point` (3 to max_fields) little-endian 32-bit floats each and
/// nothing else, x, y and z first: KITTI's .bin with 4, nuScenes' .pcd.bin with 5.
/// bad_file, invalid_argument, out_of_memory. Never throws; `out` is only changed on success.
Status read_raw_points(std::span<const std::byte> bytes, std::size_t floats_per_point, Cloud& out);

/// The same without a copy: the bytes become the cloud's rows.
Status adopt_raw_points(std::vector<std::byte> bytes, std::size_t floats_per_point, Cloud& out);

/// Writes the rows as they are. invalid_argument where a field is not a float32 or x, y and z are
/// not the first three; out_of_memory. Never throws.
Status write_raw_points(const Cloud& cloud, std::vector<std::byte>& out);

}  // namespace flagstone::io
