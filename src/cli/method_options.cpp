// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "cli/method_options.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/Option.hpp>
#include <CLI/Validators.hpp>
#include <stdexcept>
#include <string_view>
#include <utility>
#include <vector>

#include "app/config/config_file.hpp"
#include "app/config/config_toml.hpp"
#include "app/config/sensor_settings.hpp"
#include "cli/sensor_option.hpp"

namespace flagstone::cli {

void MethodOptions::add_to(CLI::App& command, std::span<const std::string_view> names) {
  command.add_option("--method", method, fmt::format("How to segment: {}", fmt::join(names, ", ")))
      ->check(CLI::IsMember(std::vector<std::string>(names.begin(), names.end())).description(""))
      ->capture_default_str()
      ->type_name("NAME");
  add_preset_option(command, preset);
  add_sensor_option(command, sensor);
  command
      .add_option("--config", config_file, "TOML file of settings, as 'flagstone config' prints")
      ->type_name("FILE");
  command
      .add_option("--set", settings, "One setting, e.g. --set elevation.enabled=false; may repeat")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  mount.add_to(command);
}

bool MethodOptions::starts_from_preset() const {
  return method == "patchwork" || method.starts_with("czm");
}

MethodConfig MethodOptions::resolve(MountSettings& mount_settings) const {
  if (!starts_from_preset() && preset != "default") {
    throw std::invalid_argument(fmt::format(
        "--preset {}: method {} has settings of its own; presets are of --method patchwork and "
        "czm+...",
        preset, method));
  }
  const std::optional<Sensor> from = chosen_sensor();
  const auto settings_at = [&](const Sensor& at) {
    return overlaid(default_config(method, at), mount_settings);
  };
  MethodConfig config =
      from ? config::settings_at_own_height(*from, settings_at)
           : overlaid(default_config(method, PatchworkConfig::preset(preset)), mount_settings);
  check(config);
  mount_settings.check();
  return config;
}

std::optional<Sensor> MethodOptions::chosen_sensor() const {
  return cli::chosen_sensor(sensor, config_file, preset);
}

MethodConfig MethodOptions::overlaid(MethodConfig config, MountSettings& mount_settings) const {
  mount_settings = {};
  if (!config_file.empty()) config::apply_file(config_file, config, mount_settings);
  for (const std::string& setting : settings) {
    const std::string source = fmt::format("--set {}", setting);
    refuse_sensor_in_setting(setting, source);
    config::apply_toml(setting, source, config, mount_settings);
  }
  mount.apply_to(config, mount_settings);
  return config;
}

CLI::Option* add_preset_option(CLI::App& command, std::string& preset) {
  const auto names = PatchworkConfig::preset_names();
  return command
      .add_option("--preset", preset, "With patchwork and czm+...: settings to start from")
      ->check(CLI::IsMember(std::vector<std::string>(names.begin(), names.end())))
      ->capture_default_str();
}

}  // namespace flagstone::cli
