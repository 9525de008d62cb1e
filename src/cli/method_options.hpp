// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <CLI/App.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "flagstone/patchwork_config.hpp"

namespace flagstone::cli {

/// The options that say how to segment, shared by the commands that do.
struct MethodOptions {
  std::string method = "patchwork";
  std::string preset = "default";
  std::string config_file;
  std::vector<std::string> settings;  ///< key=value
  std::optional<float> sensor_height;

  /// Adds the options to a command.
  void add_to(CLI::App& command);

  /// The settings they come to: preset, then file, then --set, then --sensor-height; checked.
  /// Throws std::invalid_argument with one line that says what is wrong.
  [[nodiscard]] PatchworkConfig resolve() const;
};

}  // namespace flagstone::cli
