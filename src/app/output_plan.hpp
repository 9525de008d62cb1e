// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace flagstone::app {

/// The files that a run reads and writes, listed before it writes anything: no output may replace
/// an input. Files are compared by device and inode number, so symbolic and hard links are
/// recognised; files that do not exist yet are compared by canonical path. Empty paths are ignored,
/// so that unset options can be passed as they are.
class OutputPlan {
 public:
  void reads(const std::filesystem::path& file);

  /// Adds the configuration file, the sensor file that it names, and `sensor`. Both may be empty;
  /// `sensor` may be the name of a known sensor. Throws std::invalid_argument if the configuration
  /// cannot be read.
  void reads_settings(const std::string& config_file, const std::string& sensor);

  /// Adds every file in a directory and below, except results of earlier runs: .json (but not the
  /// simulator's scene.json), .csv, .html, .png and .checkpoint.
  void reads_dataset(const std::filesystem::path& folder);

  void writes(const std::filesystem::path& file);

  /// Throws std::invalid_argument, one line that names both files, if an output is an input or if
  /// two outputs are the same file. Calls stat() once per output, and once per input if an output
  /// already exists.
  void check() const;

 private:
  std::vector<std::filesystem::path> inputs_;
  std::vector<std::filesystem::path> datasets_;
  std::vector<std::filesystem::path> outputs_;
};

}  // namespace flagstone::app
