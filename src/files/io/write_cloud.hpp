// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

#include "files/io/cloud.hpp"
#include "files/io/read_cloud.hpp"
#include "flagstone/status.hpp"

namespace flagstone::io {

/// Writes a point cloud with every field: PCD 0.7 (binary), PLY 1.0 (binary_little_endian), NPY 1.0
/// (a structured array), or raw floats if all fields are float32. The file is written atomically.
/// unwritable, invalid_argument (the format does not support a field), out_of_memory. Never throws.
Status write_cloud(const std::filesystem::path& path, CloudFormat format, const Cloud& cloud);

/// As above, in the format of the file extension; invalid_argument if the extension is unknown.
Status write_cloud(const std::filesystem::path& path, const Cloud& cloud);

}  // namespace flagstone::io
