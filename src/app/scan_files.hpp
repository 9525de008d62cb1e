// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/run.hpp"

namespace flagstone::app {

/// A scan to read, and the name of its outputs.
struct ScanInput {
  std::filesystem::path file;
  /// Relative to the output directory, without extension: "000000" for a file that was named
  /// itself, "velodyne/000000" for a file found in a directory.
  std::filesystem::path output_stem;
};

/// The named files, and all scans in the named directories and below, in alphabetical order. Files
/// that `segment` wrote next to a scan in a directory are skipped: STEM.ground.EXT with
/// STEM.nonground.EXT, and STEM.surface.npy with STEM.surface.json. callbacks.message gets their
/// number. Arrays of heights and labels are not scans.
/// Throws std::invalid_argument for a directory without scans.
std::vector<ScanInput> find_scans(const std::vector<std::string>& paths,
                                  const RunCallbacks& callbacks = {});

/// find_scans() for a command that writes outputs: also throws std::invalid_argument if two scans
/// would write to the same files.
std::vector<ScanInput> list_scans(const std::vector<std::string>& paths,
                                  const RunCallbacks& callbacks = {});

/// File name without the extensions of scans: "scene-k00" for "scene-k00.pcd.bin".
std::filesystem::path without_scan_extension(const std::filesystem::path& file);

/// The extension of a scan: ".pcd.bin" for "scene-k00.pcd.bin".
std::string scan_extension(const std::filesystem::path& file);

/// `stem` followed by `suffix`. (replace_extension() would cut off the ".v2" of "scan.v2".)
std::filesystem::path with_suffix(const std::filesystem::path& stem, const std::string& suffix);

}  // namespace flagstone::app
