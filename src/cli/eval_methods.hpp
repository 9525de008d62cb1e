// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <CLI/App.hpp>
#include <optional>
#include <string>
#include <vector>

#include "cli/mount_options.hpp"
#include "flagstone/sensor.hpp"
#include "lab/eval/method.hpp"

namespace flagstone::cli {

/// The options that say which methods are evaluated, and with which settings.
struct EvalMethods {
  std::vector<std::string> names = {"surface", "patchwork"};
  std::string preset = "default";
  std::string sensor{};  ///< name or file; empty for none
  std::string config_file{};
  std::vector<std::string> settings{};  ///< method.key=value or mount.key=value
  MountOptions mount{};
  std::vector<std::string> labels{};  ///< name=folder
  io::LabelMap label_map = io::LabelMap::flagstone;

  /// Adds the options to a command.
  void add_to(CLI::App& command);

  /// The methods in the order they are listed, each once; then those whose labels were made
  /// elsewhere. Throws std::invalid_argument with one line that says what is wrong.
  [[nodiscard]] std::vector<eval::Method> resolve() const;

 private:
  /// A setting and the method whose it is.
  struct OwnSetting {
    std::string method;
    std::string text;
  };

  /// --set, by method.
  [[nodiscard]] std::vector<OwnSetting> own_settings() const;

  /// Settings of Patchwork with file and --set laid over them, for all that start from them.
  [[nodiscard]] PatchworkConfig overlaid(PatchworkConfig config,
                                         MountSettings& mount_settings) const;

  /// Settings of one method, with --set, --sensor-height and --tilt laid over them. `from`: the
  /// sensor they are derived from, if any.
  [[nodiscard]] MethodConfig settings_of(const std::string& method,
                                         const std::optional<Sensor>& from,
                                         MountSettings& mount_settings) const;
};

}  // namespace flagstone::cli
