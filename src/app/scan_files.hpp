// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/run.hpp"

namespace flagstone::app {

/// A scan to read and what its outputs are called.
struct ScanInput {
  std::filesystem::path file;
  /// Relative to the output folder and without extension: "000000" for a file that was named
  /// itself, "velodyne/000000" for one found below a folder.
  std::filesystem::path output_stem;
};

/// Files as named, folders walked for every scan below them, in alphabetical order. In folders,
/// what segment wrote beside a scan is skipped, and callbacks.message tells how many files were:
/// STEM.ground.EXT with STEM.nonground.EXT, and STEM.surface.npy with STEM.surface.json. Arrays of
/// heights and labels are not scans.
/// Throws std::invalid_argument for a folder without scans.
std::vector<ScanInput> find_scans(const std::vector<std::string>& paths,
                                  const RunCallbacks& callbacks = {});

/// The same for a command that writes outputs: throws std::invalid_argument also if two scans would
/// write to the same files.
std::vector<ScanInput> list_scans(const std::vector<std::string>& paths,
                                  const RunCallbacks& callbacks = {});

/// File name without the extensions of scans: "scene-k00" for "scene-k00.pcd.bin".
std::filesystem::path without_scan_extension(const std::filesystem::path& file);

/// The extension that a scan's name has: ".pcd.bin" for "scene-k00.pcd.bin".
std::string scan_extension(const std::filesystem::path& file);

/// `stem` with `suffix` after it; replace_extension() would cut "scan.v2" short.
std::filesystem::path with_suffix(const std::filesystem::path& stem, const std::string& suffix);

}  // namespace flagstone::app
