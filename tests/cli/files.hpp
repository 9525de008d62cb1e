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

/// A scan for tests in the layout of KITTI: x, y, z, intensity. It has ground, walls, boxes, and a
/// few points that are noise, out of range or invalid, so that every label occurs.
io::Cloud small_scan(std::size_t points = 4000, std::uint32_t seed = 1);

/// Writes a scan in the format of the file extension; creates the directories above it.
void put_scan(const std::filesystem::path& file, const io::Cloud& scan = small_scan());

/// Reads a scan.
io::Cloud scan_of(const std::filesystem::path& file);

/// The labels of the library for a scan, with the default method.
std::vector<Label> labels_of(const io::Cloud& scan);

/// The codes in a .label file.
std::vector<std::uint32_t> codes_of(const std::filesystem::path& file);

/// Contents of every file in a directory and below, by relative name.
std::map<std::string, std::string> files_below(const std::filesystem::path& folder);

/// Sorted relative names of the files in a directory and below.
std::vector<std::string> names_below(const std::filesystem::path& folder);

}  // namespace flagstone::cli
