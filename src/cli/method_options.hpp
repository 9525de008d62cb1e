// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <CLI/App.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "cli/mount_options.hpp"
#include "flagstone/make_segmenter.hpp"
#include "flagstone/sensor.hpp"

namespace flagstone::cli {

/// The options that say how to segment, shared by the commands that run one method.
struct MethodOptions {
  std::string method = "surface";
  std::string preset = "default";
  std::string sensor;  ///< name or file; empty for none
  std::string config_file;
  std::vector<std::string> settings;  ///< key=value
  MountOptions mount;

  /// Adds the options to a command that runs any of these methods.
  void add_to(CLI::App& command, std::span<const std::string_view> names = method_names());

  /// Do the method's settings start from a preset of Patchwork?
  [[nodiscard]] bool starts_from_preset() const;

  /// The sensor that settings are derived from, by --sensor or the file, if any. Throws as
  /// resolve() does.
  [[nodiscard]] std::optional<Sensor> chosen_sensor() const;

  /// The settings they come to: preset or sensor, then file, then --set, then --sensor-height and
  /// --tilt; checked. Those of a sensor are derived for the height they come to. How the sensor
  /// stands is written to `mount_settings`. Throws std::invalid_argument with one line that says
  /// what is wrong.
  [[nodiscard]] MethodConfig resolve(MountSettings& mount_settings) const;

 private:
  /// `config` with file, --set, --sensor-height and --tilt laid over it.
  [[nodiscard]] MethodConfig overlaid(MethodConfig config, MountSettings& mount_settings) const;
};

/// Adds --preset to a command: which of Patchwork's presets to start from.
CLI::Option* add_preset_option(CLI::App& command, std::string& preset);

}  // namespace flagstone::cli
