// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

#include "files/io/cloud.hpp"
#include "files/io/read_cloud.hpp"
#include "flagstone/status.hpp"

namespace flagstone::io {

/// Writes a point cloud with every field: PCD 0.7 (binary), PLY 1.0 (binary_little_endian), NPY 1.0
/// (a structured array), or raw floats where all fields are float32. The file is there whole or not
/// at all. Never throws. unwritable, invalid_argument (the format cannot hold a field),
/// out_of_memory.
Status write_cloud(const std::filesystem::path& path, CloudFormat format, const Cloud& cloud);

/// The same with the format the path's name stands for; invalid_argument where it stands for none.
Status write_cloud(const std::filesystem::path& path, const Cloud& cloud);

}  // namespace flagstone::io
