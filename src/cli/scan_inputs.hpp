// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace flagstone::cli {

/// A scan to segment and what its outputs are called.
struct ScanInput {
  std::filesystem::path file;
  /// Relative to the output folder and without extension: "000000" for a file that was named
  /// itself, "velodyne/000000" for one found below a folder.
  std::filesystem::path output_stem;
};

/// Files as named, folders walked for every scan below them, in alphabetical order.
/// Throws std::invalid_argument for a folder without scans.
std::vector<ScanInput> find_scans(const std::vector<std::string>& paths);

/// The same for a command that writes outputs: throws std::invalid_argument also where two scans
/// would write to the same ones.
std::vector<ScanInput> list_scans(const std::vector<std::string>& paths);

/// File name without the extensions of scans: "scene-k00" for "scene-k00.pcd.bin".
std::filesystem::path without_scan_extension(const std::filesystem::path& file);

}  // namespace flagstone::cli
