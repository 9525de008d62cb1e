// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "files/io/cloud.hpp"
#include "flagstone/label.hpp"

namespace flagstone::cli {

/// A scan for tests, as KITTI has them: x, y, z, intensity; ground, walls, boxes, and a few points
/// that are noise, out of range or invalid, so that every label occurs.
io::Cloud small_scan(std::size_t points = 4000, std::uint32_t seed = 1);

/// Writes a scan in the format of the file's name, and the folders above it.
void put_scan(const std::filesystem::path& file, const io::Cloud& scan = small_scan());

/// The scan of a file.
io::Cloud scan_of(const std::filesystem::path& file);

/// What the library says of a scan, by the command's default method.
std::vector<Label> labels_of(const io::Cloud& scan);

/// The numbers of a .label file.
std::vector<std::uint32_t> codes_of(const std::filesystem::path& file);

/// Every file below a folder by its name relative to it, with its contents.
std::map<std::string, std::string> files_below(const std::filesystem::path& folder);

/// The names of the files below a folder, sorted.
std::vector<std::string> names_below(const std::filesystem::path& folder);

}  // namespace flagstone::cli
