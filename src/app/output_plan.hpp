// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace flagstone::app {

/// The files that a run reads and writes, listed before it writes anything: no output may replace
/// an input. Two names mean the same file if device and inode number are equal, which covers
/// symbolic and hard links; a file that does not exist yet is known by its canonical path. Empty
/// paths are ignored, so that unset options can be passed as they are.
class OutputPlan {
 public:
  void reads(const std::filesystem::path& file);

  /// The files that settings come from: a configuration, the sensor that it names, and a sensor.
  /// Each may be empty; a sensor may also be a name. Throws as reading the configuration does.
  void reads_settings(const std::string& config_file, const std::string& sensor);

  /// Every file below a folder is an input, except results that earlier runs may have left there:
  /// .json (but not the simulator's scene.json), .csv, .html, .png and .checkpoint.
  void reads_dataset(const std::filesystem::path& folder);

  void writes(const std::filesystem::path& file);

  /// Throws std::invalid_argument with one line that names both files if an output is an input, or
  /// if two outputs are the same file. Costs one look at each output, and one at each input if any
  /// output exists already.
  void check() const;

 private:
  std::vector<std::filesystem::path> inputs_;
  std::vector<std::filesystem::path> datasets_;
  std::vector<std::filesystem::path> outputs_;
};

}  // namespace flagstone::app
