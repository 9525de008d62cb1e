// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "cli/method_options.hpp"

#include <fmt/format.h>

#include <CLI/Option.hpp>
#include <CLI/Validators.hpp>
#include <span>
#include <stdexcept>
#include <string_view>

#include "cli/config_toml.hpp"
#include "io/load_bytes.hpp"

namespace flagstone::cli {
namespace {

void apply_file(const std::string& file, PatchworkConfig& config) {
  io::FileBytes bytes;
  const Status status = io::load_bytes(file, bytes);
  if (!status.ok()) throw std::invalid_argument(status.message());
  const std::span<const std::byte> span = std::as_const(bytes).span();
  apply_toml({reinterpret_cast<const char*>(span.data()), span.size()}, file, config);
}

}  // namespace

void MethodOptions::add_to(CLI::App& command) {
  const auto names = PatchworkConfig::preset_names();
  command.add_option("--method", method, "How to segment: patchwork")
      ->check(CLI::IsMember({"patchwork"}))
      ->capture_default_str();
  command.add_option("--preset", preset, "Settings to start from: default, paper or reference")
      ->check(CLI::IsMember(std::vector<std::string>(names.begin(), names.end())))
      ->capture_default_str();
  command
      .add_option("--config", config_file, "TOML file of settings, as 'flagstone config' prints")
      ->type_name("FILE");
  command
      .add_option("--set", settings, "One setting, e.g. --set elevation.enabled=false; may repeat")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  command.add_option("--sensor-height", sensor_height, "Height of the sensor above ground, metres")
      ->type_name("M");
}

PatchworkConfig MethodOptions::resolve() const {
  PatchworkConfig config = PatchworkConfig::preset(preset);
  if (!config_file.empty()) apply_file(config_file, config);
  for (const std::string& setting : settings) {
    apply_toml(setting, fmt::format("--set {}", setting), config);
  }
  if (sensor_height) config.sensor_height = *sensor_height;
  config.check();
  return config;
}

}  // namespace flagstone::cli
